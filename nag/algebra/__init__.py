"""Exact polynomials over abelian fields of real numbers, and systems of them.

Read in this order, bottom-up: `root_basis` and `surd` (sums of square roots and cosines), `number`,
`polynomial`, `system` (the data), with `flint_numbers` (FLINT's rationals); `tokens`, `bounded`,
`expression` and `from_python` (with `from_sympy` and `given`: text and Python's numbers in;
`to_sympy`: out); `imaginary_unit` (complex coefficients); `evaluation` (in doubles); `exact_ranks`,
`elimination`, `symmetry`, `combinations` and `turns` (what equations show at once);
`factoring` (on `conjugate_factors`), `branches` (on `branch_search`, `branch_equations` and
`consequences`), `algebraic_zeros` (with `bivariate`), `zero_count` and `generic_multiplicity` (what
exact algebra decides before any path is tracked); `groebner`, `smoothness` and `multipliers`
(ideals); `rational_function` and `interpolation`; `family`, `rational_map` and `symmetric_family`
(systems with parameters). `fixed_mapping` holds what results map names to.
"""
