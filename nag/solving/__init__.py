"""All isolated solutions of a system.

Read in this order, top-down: `solve` (the methods, the bounds of the number of zeros, the finders)
on `solutions` (the data, with `shown`); `branch_solutions` (what exact factoring decides: each
branch solved, and their solutions joined without repeats, by `nag.numerics.branch_union`);
`path_search` (what is asked, and what paths show) on `square_problem` (what is tracked),
`path_ends` (what became of it), `end_judgements` (judged one by one or in blocks) and
`isolated_zero`; `missing_zeros` with `tropical_zeros` (what no
path reached); `start` (systems that are solved already); `parameter` (families, tracked from one
member to others) with `parameter_line`, `solution_classes` and `solve_classes`; `family_members` on
`member_lines` (many members together); `kantorovich`,
`certificate` with `solution_claims`, and `certified_paths` prove.

All lists stand in `solve`, in the order in which they are asked. A method is a function of a
`path_search.SolveTask` and `solve.Others` (which solve a part of it by the methods after this one)
that makes a `solutions.SolveResult` or None; it stands in `METHODS` with the sentence that is
printed of it, and in `EXACT` if members of families are asked it as well. A bound makes a
`path_search.Bound` or None of a `path_search.PathSearch`, and stands in `BOUNDS`; a finder makes
another search of it, and stands in `PATHLESS` or, if it tracks paths again, in `AGAIN`. What
`parameter` solves as a member of a family names ``by_family`` as its method, which is in no list.
"""
