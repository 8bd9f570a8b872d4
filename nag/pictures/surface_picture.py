"""Surfaces in three variables, by the lines in which planes cut them.

The closure of a component's image in three variables is the zeros of one polynomial. On a grid in
a plane its sign says where zeros run, so that lines are drawn where it changes: isolated points and
curves of real zeros, at which it does not, are not seen.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.pictures.picture_file import COLOURS, STYLE, save
from nag.pictures.space_curves import AZIMUTH, ELEVATION

# Planes in each of three directions, and points of a grid on a side.
PLANES, GRID = 17, 121


def draw_surface(
    equations: Sequence[tuple[str, Polynomial]],
    names: Sequence[str],
    size: float,
    title: str,
    path: str,
) -> None:
    """Lines of surfaces in planes, each surface in a colour of its own.

    Args:
        equations: polynomials in three variables, each with what it is called.
        names: of the variables.
        size: what is shown has no larger coordinates.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    sides = np.tile(size * np.linspace(-1, 1, GRID), (3, 1))
    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(5.2, 5.2), layout="constrained")
        space = figure.add_subplot(projection="3d")
        for k, (label, equation) in enumerate(equations):
            colour = COLOURS[k % len(COLOURS)]
            for line in find_lines(equation, sides):
                space.plot(*line.T, color=colour, linewidth=0.5, label=label)
        for axis, name, side in zip("xyz", names, sides, strict=True):
            getattr(space, f"set_{axis}label")(name)
            getattr(space, f"set_{axis}lim")(side[0], side[-1])
        space.view_init(ELEVATION, AZIMUTH)
        space.set_box_aspect((1, 1, 1))
        space.set_title(title, fontsize=9)
        handles = dict(zip(*reversed(space.get_legend_handles_labels()), strict=True))
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3,
                      frameon=False)  # fmt: skip
        save(figure, path)


def find_lines(equation: Polynomial, sides: np.ndarray) -> list[np.ndarray]:
    """Lines in which planes across each axis cut the zeros of a polynomial.

    Args:
        sides: values of the three variables, ascending, shape ``(3, g)``.

    Returns:
        Points in their order, shape ``(k, 3)`` each.
    """
    from contourpy import contour_generator

    evaluator = Evaluator.of([equation], 3)
    found = []
    for across in range(3):
        first, second = (i for i in range(3) if i != across)
        grid = np.zeros((sides.shape[1], sides.shape[1], 3))
        grid[..., first], grid[..., second] = np.meshgrid(sides[first], sides[second])
        for value in np.linspace(sides[across, 0], sides[across, -1], PLANES + 2)[1:-1]:
            grid[..., across] = value
            values = evaluator.values(grid.reshape(-1, 3)).real.reshape(grid.shape[:2])
            for line in contour_generator(sides[first], sides[second], values).lines(0.0):
                points = np.full((len(line), 3), value)
                points[:, [first, second]] = line
                found.append(points)
    return found
