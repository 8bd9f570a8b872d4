"""Robots as simulators describe them: trees of links with joints, and loops that are closed.

Read in this order, bottom-up: `xml_file` (elements that know their places), `robot` (the tree, and
the mechanism that it is with its hand held, on `nag.mechanism.given_rotation`); then `urdf` and
`mjcf` on these, and `reading`, which tells them apart. A case of kind ``robot``
(`nag.files.robot_case`) says more about such a file.
"""
