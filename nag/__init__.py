"""Numerical algebraic geometry for mechanisms."""
