"""How a mechanism moves really: all bodies along the real curves of its configurations.

Read in this order, bottom-up: `poses` (places and turns of bodies at many points at once), `scene`
on `poses` (bodies and joints of a mechanism, a linkage, a framework or a table, and where they are
at points of its equations), `joint_values` (angles and slides), `walks` (how arcs of a real curve
follow each other, in the coordinates of `nag.real.spherical_chart`), `path` on `scene` and `walks`
(one motion along them, evenly sampled), `turning_points` (where joints stand still), `driven`
(joints held at values, bodies at places), `rigid_assemblies` (those that do not move), `motion`
(all that is said of a mechanism; `shown` for users) and `driven_motion` (one value of a joint after
another).
"""

# For whoever must not load the rest. Values that a joint is driven through, at most.
MOST_VALUES = 1_000
# What is said to whoever gives an open arm, and to whoever places a body on it that is too near.
CLOSE_A_LOOP = "hold a body to close a loop: the hand at a pose"
HOLD_FARTHER = "a body that is placed needs two joints or more between the ground and itself"
