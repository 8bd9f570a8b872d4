"""Numbers that each of the eight lanes keeps of its path: what it does, and how it stands."""

# What a lane does.
IDLE, STEP, FINISH = 0.0, 1.0, 2.0
# Rows of the lanes' scalars, and their number.
SCALARS = 23
(
    MODE,
    PATH,
    T,
    H,
    FIRST,
    LAST,
    CONTRACTION,
    SETTLED,
    CURVATURE,
    TAKEN,
    TRIED,
    WINDING,
    WAITED,
    KNOWN,
    BASE,
    REJECTED,
    WANTED,
    EXCESS,
    SAVED,
    EVALUATED,
    ROUGH,
    SEEN_T,
    SEEN_RADIUS,
) = range(SCALARS)
