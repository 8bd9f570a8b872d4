"""Benchmarks: systems, times, and other programs beside ours.

Bottom-up: read `step_parts` (where a step's time goes), `measure` (solving), `path_costs` (of very
many paths), `chains`, `decomposition`, `models`, then `peers` (other programs) and `table`, on
`timed_runs`. Speed against accuracy: `reference` (solutions, proved), `work_precision` (what is
charted: `sharpening`, `whole_paths`), `speed_accuracy` (solutions), `component_curves`, and what
other programs find, `peer_points` and `peer_components`; `speed_accuracy_picture` draws it.
`verdicts` says whether answers are right; `atlas` is where methods fail.
"""
