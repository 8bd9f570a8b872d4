"""All isolated solutions of a system.

Read in this order: `solve` (the methods, the bounds, the finders) on `solutions` (the data, with
`shown`); `branch_solutions` (what exact factoring decides); `path_search` (what is asked, and what
paths show) on `square_problem` (what is tracked), `path_ends` (what became of it) and
`isolated_zero`; `missing_zeros` with `tropical_zeros` (what no path reached); `start` (systems that
are solved already); `parameter` (families, tracked from one member to others) with
`parameter_line`, `solution_classes` and `solve_classes`; `kantorovich`, `certificate` with
`solution_claims`, and `certified_paths` prove.

To add a method, a bound or a finder, write a function of a `path_search.SolveTask`, or of a
`path_search.PathSearch`, and put it in its list in `solve` at the place where it is to be asked.
"""
