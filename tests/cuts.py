"""Points of plane curves on random lines, as fibres."""

from __future__ import annotations

import numpy as np
from systems import system

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.witness.cutting import Cut, sharpen
from nag.witness.fibres import Fibre


def curve(equation: str) -> Polynomial:
    """A polynomial in x and y."""
    return system("x y", equation).polynomials[0]


def points_on(f: Polynomial, row: np.ndarray) -> np.ndarray:
    """The points of ``f = 0`` on the line ``row[0] + row[1] x + row[2] y = 0``, shape (P, 2)."""
    start = -row[0] * row[1:].conj() / np.linalg.norm(row[1:]) ** 2
    direction = np.array([-row[2], row[1]])
    nodes = np.exp(2j * np.pi * np.arange(f.degree + 1) / (f.degree + 1))
    evaluator = Evaluator.of([f], 2)
    values = evaluator.values(start + nodes[:, None] * direction)[:, 0]
    roots = np.roots((np.fft.fft(values) / len(nodes))[::-1])
    guesses = start + roots[:, None] * direction
    return np.array([sharpen(evaluator, row[None], z).z for z in guesses])


def fibre(equation: str, row: np.ndarray) -> Fibre:
    """All points of a reduced plane curve on a line."""
    f = curve(equation)
    return Fibre(Cut(2, 0, (f,)), row[None], points_on(f, row))
