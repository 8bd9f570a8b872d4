"""Witness sets and what is done with one of them.

Read in this order, bottom-up: `witness` (the data, a `Slice` among them; `shown` for users),
`slices` (random ones), `cutting` (the local equations that cut a set at its points) on
`isosingular` (deflation), `fibres` and `points` (points on a slice; `fibres.move` moves the slice:
it tracks them to another in coordinates of comparable sizes), `component_equations` (held, or found
anew), `exact_points` (found in as many digits as are asked for), `close_points`, `confirm`,
`multiplicity`, `close_to_sets` and `cutting_in_digits` (what is known of them, and of those that
doubles do not tell apart); then the operations on a set as it is given (`given_component`):
`moving` (to a slice that is given), `product`, `membership`, `sampling`, `projection`,
`real_points` by `gauss_newton`, `constraints` (for equations of motion). `change_of_coordinates`
leads to natural ones, where these operations begin, and back; `frame` leads from what solving
linear equations left, and from an orbit to its components; `certificate` with `component_claims`,
and `certified_loops` prove.

Points on a slice are held by what is known of them: a `fibres.Fibre` has those that one square
system cuts, `points.Points` those of several systems under indices that stay, `fibres.SliceEnds`
where paths ended, `exact_points.SharpPoints` points to rounding with their errors, and a
`witness.WitnessSet` these with what was found out of the component. Points of all dimensions on one
flag of slices are a `nag.decomposition.superset.Superset`.
"""
