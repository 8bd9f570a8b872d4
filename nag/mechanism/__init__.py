"""Mechanisms: bodies and joints, and the smallest polynomial systems that model them.

Read in this order, bottom-up: `graph` on `joint_types` (the data), `networkx_graph`; `axes`,
`quaternion` (vectors, turns); `lines` (loops by their axes); `loops` (what can move);
`formulations` (each in `FORMULATIONS`) and `model` (the choice, by `path_estimates`); the
formulations `planar` and `euler` (each with its loop equations), and `half_angles` and `rods` on
`joint_factors` and `loop_product` (their loop equations); `assembly_modes`, `mode_classes` and
`mode_decomposition`; `configuration` (all bodies), `holding` on `given_rotation` (joints held at
values, bodies put elsewhere), and `unreduced` (all constraints, for checks). Other ways to give one
are `framework` (with `framework_model`, `isotropic` and `framework_decomposition`), `dh` and
`linkage`, on `assembly` and `real_assemblies` (with `straight_lines`); `parts` tells which of them
is given. `problem` is what all of these come down to, and cases and equations with them, and what
`nag.decompose` and `nag.solve` ask; `coordinates` carries its components over to Euler parameters,
`other_equations` are those that must say the same. `mobility_at` with `mobility_report` and `bonds`
says how one moves, `moving_parts` (on `joint_chains`, of parts on `assembled`) what of it,
`body_on_component` how a body does along a component, and `nearly_mobile` (on `overconstrained`)
how it would if it were not rigid as it is given; `operation_modes` with `modes_report` how the
platform of a parallel robot does, by `legs`, `leg_image`, `isotropic_limits`, `platform`,
`inverse_kinematics` and `motions`, and `pose_model` makes a formulation of its poses, taken on
request, where all others have very many paths, or with joints held where `leg_ways` says all that
a leg can do at each; `shown` is what is
seen at the prompt.

To add a type of joint, write its record in `joint_types.JOINT_TYPES`, by the rules at the head of
that file, and a row in `docs/cases.md`: all formulations, case files, graphs and tables read it
from there, and nothing asks for its name. A new kind of factor is a record in
`joint_types.FACTOR_KINDS`, and has its generators in `joint_factors`. Something new that is given
of a joint, as a pitch, is a field of `graph.Joint` (where `networkx_graph` and `shown` find it) and
in `joint_types.VECTORS`, and `nag.files.mechanism_case` reads it.
"""

# For whoever must not load them: seconds that the degree of a component may take, and operation
# modes, and names of the formulations.
BUDGET = 10
MODES_BUDGET = 60
FORMULATIONS = {
    "E": "Euler parameters, in the plane a cosine and a sine for each body",
    "H": "half-angles, slides and quaternions of the joints",
    "S": "rods between spherical joints as distances, free bodies in Study coordinates",
}
# The platform's poses alone, taken on request, with joints held, or to decompose a robot with very
# many paths; and what is known of a robot's modes.
PLATFORM_ALONE = "P"
