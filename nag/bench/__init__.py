"""Benchmarks: systems, times, and other programs beside ours."""
