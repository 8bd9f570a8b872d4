"""Mechanisms: bodies and joints, and the smallest polynomial systems that model them.

Read in this order: `graph` on `joint_types` (the data), `networkx_graph`;
`axes`, `quaternion` (vectors, turns); `loops` (what can move); `formulations` (by
`formulation_names`) and `model` (the choice, by `path_estimates`); the formulations `planar`,
`euler`, and `half_angles` and `rods` on `joint_factors` and `loop_product`; `assembly_modes`,
`mode_classes` and `mode_decomposition`; `configuration`, `projection` and `coordinates` (from one
formulation to another), and `unreduced` (all constraints, for checks).
Other ways to give one are `framework` (with `framework_model`, `isotropic` and
`framework_decomposition`), `dh` (with `dh_euler`) and `linkage`, on `assembly` and
`real_assemblies`; `parts_coordinates` is what each of their coordinates would cost, and what others
must agree with. `problem` is what all of these come down to, and cases and equations with them.
`mobility_at` with `mobility_report` and `bonds` says how one moves; `shown` is what is seen at the
prompt.
"""
