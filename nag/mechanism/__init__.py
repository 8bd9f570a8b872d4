"""Mechanisms: bodies and joints, and the smallest polynomial systems that model them.

Read in this order: `graph` on `joint_types` (the data); `axes` and `quaternion` (vectors, turns);
`loops` (what can move); `formulations` and `model` (the choice, by `path_estimates`); the
formulations `planar`, `euler`, and `half_angles` and `rods` on `joint_factors` and `loop_product`;
`assembly_modes`, `mode_classes` and `mode_decomposition`; `configuration`, and `unreduced` (all
constraints, for checks). `framework` (with `isotropic` and `parts_decomposition`), `dh` and
`linkage` are other ways to give one (`assembly`), and `parts_coordinates` what each of their
coordinates would cost; `mobility_at` with `mobility_report` and `bonds` says how one moves;
`another_model` (with `pins`) has other equations of the same parts, to compare.
"""
