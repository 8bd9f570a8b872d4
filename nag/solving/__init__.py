"""All isolated solutions of a system.

Read in this order: `solve` on `solutions` (the data, with `shown`) with `square_problem` (what is
tracked) and `judged_ends` (what became of it, `isolated_zero`, `larger_sets`); `conjugate_ends` and
`missing_zeros` with `tropical_zeros` (what no path reached, and whether that is all); `start`
(systems that are solved already); `branch_solutions` with `lifted_solution` (what exact factoring
decides); `parameter` (families, tracked from one member to others) with `parameter_line`,
`solution_classes` and `solve_classes`; `kantorovich`, `certificate` with `solution_claims`, and
`certified_paths` prove.
"""
