"""Robots as simulators describe them: trees of links with joints, and loops that are closed.

Read in this order, bottom-up: `xml_file` (elements that know their lines), `given_rotation`
(angles, axes and quaternions in rounded numbers, as exact rotations), `robot` (the tree, and the
mechanism that it is with its hand held); then `urdf` and `mjcf` on these.
"""
