"""Benchmarks: systems, times, and other programs beside ours.

Read `measure` (solving), `decomposition`, then `peers` (other programs) and `table`. Speed against
accuracy: `work_precision` (what is charted), `speed_accuracy` (solutions), `component_curves`, and
what other programs find, `peer_points` and `peer_components`.
"""
