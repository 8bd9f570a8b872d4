"""All isolated solutions of a system.

Read in this order: `solve` (the methods, the bounds, the finders) on `solutions` (the data, with
`shown`) and `solve_task` (a system and what is known of it); `branch_solutions` with
`lifted_solution` (what exact factoring decides); `path_search` on `square_problem` (what is
tracked) and `path_ends` (what became of it, `isolated_zero`, `larger_sets`); `conjugate_ends` and
`missing_zeros` with `tropical_zeros` (what no path reached); `start` (systems that are solved
already); `parameter` (families, tracked from one member to others) with `parameter_line`,
`solution_classes` and `solve_classes`; `kantorovich`, `certificate` with `solution_claims`, and
`certified_paths` prove.
"""
