"""Witness sets and what is done with one of them.

Read in this order: `witness` (the data), `slices`, `cutting` (the local equations that cut a set
at its points) on `isosingular` (deflation), `fibres` and `points` (points on a slice, tracked to
another), `comparable` (in coordinates of comparable sizes), `exact_points` (found in as many digits
as are asked for), then the operations:
`moving`, `membership`, `sampling`, `projection`, `real_points`. `frame` and `expansion` lead back
to the coordinates and the components that the user has.
"""
