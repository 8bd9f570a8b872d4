"""Pictures as files, drawn by matplotlib.

Read in this order, bottom-up: `picture_file` (how figures look and are written), `plane_curves`
(curves in a plane, where coordinates may be angles), `space_curves` (in space), `curve_picture`
(projections of real curves), `surface_picture` (surfaces in space) and `motion_picture` (angles of
joints, and paths of points) on these, `joint_graph` (bodies and joints), `mechanism_picture` (where
they are) and `component_tree`; then `plot`, which draws what it is asked for.
"""
