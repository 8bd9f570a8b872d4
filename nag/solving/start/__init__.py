"""Start systems: solved ones, from which paths lead to the target.

Read in this order: `target` (a system made ready), `choice`, then the kinds:
`total_degree` with `interchange` (one path for all that are its images), `multihomogeneous`,
`polyhedral` on `mixed_cells`, and `isotropic`, which takes one to turns in loops; `monodromy` on
`fibre_monodromy`, `family_monodromy` with `scalings`.

To add a start system, write a file whose function makes a `target.Start` of a `target.Target`, name
it in `KINDS`, and say in `choice` when it is taken.
"""

# What may be asked for by name.
KINDS = ("auto", "total", "multihomogeneous", "polyhedral", "monodromy")
