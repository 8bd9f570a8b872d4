"""All isolated solutions of a system.

Read in this order: `solve` on `solutions` (the data) with `square_problem` (what is tracked) and
`judged_ends` (what became of it), `counted` (whether that is all);
`conjugate_ends` and `missing_zeros` with `tropical_zeros` (what no path reached); `start` (systems
that are solved already); `branch_solutions` with `lifted_solution` (what exact factoring decides);
`parameter` (families, tracked from one member to others) with `parameter_line`, `solution_classes`
and `solve_classes`; `kantorovich` proves.
"""
