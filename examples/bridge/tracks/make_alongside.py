#!/usr/bin/env python3
"""Writes alongside.csv: a coaster is laid alongside the quay of scenes/quay.scene, bow to the east, port side to.

    python3 examples/bridge/tracks/make_alongside.py > examples/bridge/tracks/alongside.csv
"""

START = {"east": -17.0, "north": -12.0, "heading_deg": 70.0}
# The quay's face is at north 20; half the beam is 4.5 m, the fenders keep 1.5 m.
END = {"east": 4.0, "north": 14.0, "heading_deg": 90.0}
HOLD, WAY, REST = 5.0, 90.0, 15.0  # s: waits, comes alongside, lies there


def smoother(s):
    """From 0 to 1 with no speed and no acceleration at either end (Perlin 2002)."""
    s = min(max(s, 0.0), 1.0)
    return s ** 3 * (s * (6.0 * s - 15.0) + 10.0)


def place(time):
    # She comes ahead first and is set on to the quay later.
    share = {"east": smoother((time - HOLD) / (0.8 * WAY)), "north": smoother((time - HOLD) / WAY),
             "heading_deg": smoother((time - HOLD - 0.3 * WAY) / (0.7 * WAY))}
    return {key: START[key] + share[key] * (END[key] - START[key]) for key in START}


def main():
    print("# Laid alongside the quay of scenes/quay.scene; made by make_alongside.py. Place of the ship's origin, on the")
    print("# waterline amidships. Seconds, metres, degrees clockwise from north.")
    print("time,east,north,heading_deg")
    for second in range(int(HOLD + WAY + REST) + 1):
        now = place(float(second))
        print(f"{second},{now['east']:.3f},{now['north']:.3f},{now['heading_deg']:.3f}")


main()
