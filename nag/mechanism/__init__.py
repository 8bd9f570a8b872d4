"""Mechanisms: bodies and joints, and the smallest polynomial systems that model them.

Read in this order: `graph` on `joint_types` (the data); `loops` (what can move);
`formulations` and `model` (the choice); the formulations `planar`, `euler`, `half_angles`, `rods`;
`assembly_modes` and `mode_decomposition`; `unreduced` (all constraints, for checks). `framework`
(with `isotropic` and `parts_decomposition`), `dh` and `linkage` are other ways to give one, and
`parts_coordinates` what each of their coordinates would cost;
`mobility_report` says how one moves; `another_model` (with `pins`) has other equations of the same
parts, to compare.
"""
