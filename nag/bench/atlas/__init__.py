"""The atlas of stability: families with a knob that walks to where methods fail.

Read in this order, top-down: `families` (all of them) on `points`, `curves` and `linkages` (what is
known of each), `nine_points`, `moved` (cases that ship, in other coordinates by `changes`); `asked`
(what a family asks for), `stability` (the runs), `picture`.
"""
