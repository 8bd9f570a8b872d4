"""Homotopy path tracking: predictor, corrector, endgame, precision."""
