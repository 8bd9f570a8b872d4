"""Ends of paths in as many digits as they need.

What a straight run in doubles leaves doubtful is followed in the logarithm of t, from a point
where it was safe: `kernel` tracks, `branch` reads the power series, `infinity` asks the exact
equations, `ends` puts them together.
"""
