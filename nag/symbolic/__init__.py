"""The prime components of the founding papers, as formulas that take numbers, functions, balls.

T25 is J. Tuomela, Analysis of kinematics of mechanisms containing revolute joints (2025); PT13 is
S. Piipponen and J. Tuomela, Algebraic analysis of kinematics of multibody systems (2013). Every
formula names its equation. Where a paper is misprinted the formula is what is true, and
``printed=True`` gives what is printed; `cases/ERRATA.md` has the list. `nag.check` tests them.
"""
