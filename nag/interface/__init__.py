"""The functions for a Python session: whatever describes a problem goes in.

`problem` turns mechanisms, models, cases, systems, sympy's equations and texts into an exact system
and its symmetries; `decompose` and `solve` hand that on to `nag.decomposition` and `nag.solving`,
which take systems only. Start with `problem`.
"""
