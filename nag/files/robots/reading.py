"""Which format a robot's file has, told by its content, and the robot in it."""

from __future__ import annotations

from nag.algebra.tokens import nearest
from nag.files.case_table import CaseError, line_of
from nag.files.robots import mjcf, urdf
from nag.files.robots.robot import Robot
from nag.files.robots.xml_file import parse_xml

_MODULES = {"urdf": urdf, "mjcf": mjcf}


def recognise_robot(file: str, text: str) -> str:
    """The name of the format of a text in XML.

    Raises:
        CaseError: if it is that of no robot.
    """
    for name, module in _MODULES.items():
        if module.recognise(text):
            return name
    message = "is no robot: it has no <robot> (URDF) and no <mujoco> (MJCF)"
    if not text.lstrip().startswith("<"):
        raise CaseError(line_of(file, message))
    root = parse_xml(file, text)
    root.fail(message + nearest(root.tag, ("robot", "mujoco")))


def read_robot(file: str, text: str, format: str = "auto") -> Robot:
    """The robot that a text describes.

    Raises:
        CaseError: if it makes no sense; one line says where, and what would be right.
    """
    name = recognise_robot(file, text) if format == "auto" else format
    return _MODULES[name].read(file, text)
