"""The atlas of stability: families with a knob that walks to where methods fail."""
