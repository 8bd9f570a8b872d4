"""From numbers to exact algebra: what vanishes on a component, found from its points.

Read in this order, bottom-up: `precise_samples` (random points of many digits), `point_cloud` (as
many as are needed, in all variables), `vanishing` (polynomials that vanish), `essential` (maps to
the other variables), `proof` (that they hold), `image_ideal` (all of it together); `conjugates`
(components that are conjugate over the rational numbers); `image_forms` (what vanishes on the image
of a map that is known by a formula, modulo primes). `shown` is what of it is printed.
"""
