"""Numbers of many digits and what they decide: rank, deflation, local rings, proofs.

In order of reading: `digits` and `power_series` (arithmetic), `implicit_function` (the regular part
of equations solved by series), `deflation` (a singular zero made a regular one) with `second_round`
(how, where Jacobians do), `dual_space` (the dimension of its local ring), `far_along` and `curves`
(zeros beside it), `singular_point` (all of it together); `local_dimension` on `located_zero` and
`dimension_bounds` (the dimension at any point), and `tangent_cone`; `krawczyk`
on `discs` and `ball_polynomials` (boxes that hold one zero), `close_zeros` (of zeros that doubles
do not tell apart).
"""
