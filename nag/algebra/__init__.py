"""Exact polynomials over the rationals, and systems of them.

Read in this order: `number`, `polynomial`, `system` (the data); `expression` and `from_python`
(text and Python's numbers in); `evaluation` (in doubles) and `high_precision`; `linear_algebra`
and `prime_field`; `elimination`, `symmetry`, `combinations` (of equations); `factoring`, `branches`
(on `branch_search` and `consequences`) and `algebraic_zeros` (what exact algebra decides before any
path is tracked); `division`, `groebner` and `hilbert`
(ideals).
"""
