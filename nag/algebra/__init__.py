"""Exact polynomials over the rationals, and systems of them."""
