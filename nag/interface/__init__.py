"""The functions for a Python session: whatever describes a problem goes in.

`nag.mechanism.problem` makes one problem of mechanisms, models, parts, cases, systems, sympy's
equations and texts; `decompose` and `solve` hand it on to `nag.decomposition` and `nag.solving`,
which take systems only.
"""
