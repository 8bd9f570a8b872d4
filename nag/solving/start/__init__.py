"""Start systems: solved ones, from which paths lead to the target.

Read in this order, bottom-up: `target` (a system made ready, and what a start system is); the kinds
`total_degree` on `interchange` (one path for all that are its images), `multihomogeneous`,
`polyhedral` on `mixed_cells` and `invariance` (coefficients that symmetries keep), and
`monodromy`, both on `coefficient_monodromy`, which runs `monodromy_loops`; `choice` (the kind that
is asked for, or has the least work). Two begin elsewhere, and are no kinds: `isotropic`, which
takes systems to turns in loops (`nag.solving.solve.by_turns`), and `family_monodromy`, the same
loops, on `scalings`, for members of families (`nag.solving.parameter`, `--start parameter`).

To add a start system, write a file whose function makes a `target.StartSystem` of a
`target.Target`; name the kind in `KINDS`, in the enum ``start`` of
`nag/files/schema/nag-solutions-1.json` (a test holds the two together) and in the table of
``--start`` in `docs/commands.md`; make it in `choice._make_start`, where it is asked for, and say
in `choice._least_work` when it is taken unasked. `nag.solving.certified_paths` proves paths from
every kind but monodromy, in whose place it takes the one with the least work.
"""

KINDS = ("total", "multihomogeneous", "polyhedral", "monodromy")
# What may be asked for by name: a kind, or that `choice` takes the one with the least work.
ASKED_FOR = ("auto", *KINDS)
