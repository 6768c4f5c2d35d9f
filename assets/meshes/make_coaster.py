#!/usr/bin/env python3
"""Write the coaster's meshes: coaster_hull.obj (watertight, for physics) and coaster.obj + coaster.mtl (for drawing).

An original small coaster of 36 m length, 9 m beam and 2.8 m draft. Body axes: x forward, y port, z up; the origin is
amidships on the design waterline (z = 0). Metres. Every face is wound counter-clockwise seen from outside.

    python3 make_coaster.py [FOLDER]

The script refuses to write a hull that is not closed, not outward or not of the size stated.
"""
import math
import os
import sys

from mesh_writer import Mesh, add_hull, add_plates, check_closed, mix, smoothstep, write_materials

AXES = "Body axes: x forward, y port, z up; z = 0 is the design waterline; metres."
LENGTH, BEAM, DRAFT = 36.0, 9.0, 2.8
BOOT_LOW, BOOT_TOP = 0.22, 0.46  # m, the white stripe above the waterline
STATIONS = 48
ROWS_BELOW, ROWS_ABOVE = 9, 4  # up to the stripe's lower edge, and from its upper edge to the deck

MATERIALS = {  # name: diffuse colour, linear RGB
    "antifouling": (0.28, 0.045, 0.035),
    "boot_top": (0.75, 0.76, 0.74),
    "topside": (0.022, 0.045, 0.095),
    "deck": (0.27, 0.085, 0.055),
    "hatch": (0.13, 0.20, 0.16),
    "coaming": (0.30, 0.32, 0.32),
    "house": (0.80, 0.81, 0.79),
    "window": (0.012, 0.018, 0.024),
    "funnel": (0.62, 0.30, 0.035),
    "black": (0.02, 0.02, 0.022),
    "mast": (0.72, 0.70, 0.60),
    "boat": (0.75, 0.16, 0.02),
}


def deck_height(u):
    """Sheer line with a raised forecastle; u from 0 (transom) to 1 (stem)."""
    return 1.85 + 0.25 * (1.0 - u) ** 4 + 0.35 * u**3 + 1.05 * smoothstep(0.80, 0.86, u)


def keel_height(u):
    """Flat keel; the counter rises to the transom."""
    return -DRAFT + 2.2 * (1.0 - smoothstep(0.0, 0.16, u))


def stem_x(z):
    """Raked stem with a rounded forefoot."""
    above = 1.30 * max(z, 0.0) / 3.5
    below = 0.9 * (min(z, 0.0) / -DRAFT) ** 2
    return 16.70 + above - below


def stern_x(z):
    return -LENGTH / 2 + 0.12 * (2.1 - z) * 0.5


def plan_form(u, height):
    """Half-breadth as a fraction of half the beam; height 0 at the bilge, 1 at the waterline, 2 at the deck."""
    waterline_entry = 1.0 - max((u - 0.58) / 0.42, 0.0) ** 1.9
    deck_entry = 1.0 - max((u - 0.66) / 0.34, 0.0) ** 2.5
    waterline_run = mix(0.70, 1.0, smoothstep(0.0, 0.26, u))
    deck_run = mix(0.90, 1.0, smoothstep(0.0, 0.20, u))
    blend = min(max(height - 1.0, 0.0), 1.0) ** 1.3
    return mix(waterline_entry, deck_entry, blend) * mix(waterline_run, deck_run, blend)


def section(u):
    """One side of a station, from the keel to the deck edge: [(half breadth, z)]."""
    fullness = 4.5 * smoothstep(0.02, 0.30, u) * (1.0 - smoothstep(0.62, 0.98, u)) + 1.35
    keel = keel_height(u)
    points = []
    for j in range(ROWS_BELOW + 1):
        angle = 0.5 * math.pi * j / ROWS_BELOW
        across = math.sin(angle) ** (2.0 / fullness) if j else 0.0
        up = 1.0 - math.cos(angle) ** (2.0 / fullness) if j < ROWS_BELOW else 1.0
        points.append((across * plan_form(u, up), mix(keel, BOOT_LOW, up)))
    deck = deck_height(u)
    for z in [BOOT_TOP] + [mix(BOOT_TOP, deck, j / ROWS_ABOVE) for j in range(1, ROWS_ABOVE + 1)]:
        points.append((plan_form(u, 1.0 + (z - BOOT_LOW) / (deck - BOOT_LOW)), z))
    return [(0.5 * BEAM * across, z) for across, z in points]


def add_coaster_hull(mesh):
    rows = ROWS_BELOW + 1 + ROWS_ABOVE
    bands = (("hull_bottom", "antifouling", 0, ROWS_BELOW), ("hull_boot_top", "boot_top", ROWS_BELOW, ROWS_BELOW + 1),
             ("hull_topside", "topside", ROWS_BELOW + 1, rows))
    return add_hull(mesh, STATIONS, section, lambda u, z: mix(stern_x(z), stem_x(z), u), bands, 0.02)


def check_hull(mesh):
    """Closed, outward, and of the size stated."""
    volume, low, high = check_closed(mesh)
    assert abs(high[0] - low[0] - LENGTH) < 0.1 and abs(high[1] - low[1] - BEAM) < 0.05 and abs(low[2] + DRAFT) < 0.01
    return volume, low, high


def add_bulwark(mesh, edge):
    """A thin plate that stands on the deck edge of the forecastle, and a low gunwale along the main deck."""
    forecastle = int(0.80 * STATIONS)
    add_plates(mesh, edge, (("bulwark", "topside", forecastle, STATIONS, 0.85), ("gunwale", "topside", 0, forecastle, 0.22)))


def add_outfit(mesh):
    part = mesh.part
    holds = ((-5.2, 3.2), (4.2, 11.2))
    part("hatch_coaming", "coaming", [(h, (-3.1, 3.1), (1.75, 2.75)) for h in holds])
    part("hatch_cover", "hatch", [((a - 0.15, b + 0.15), (-3.25, 3.25), (2.75, 3.05)) for a, b in holds], 0.08)
    seams = [((x, x + 0.12), (-3.2, 3.2), (3.05, 3.13)) for a, b in holds for x in [a + 1.4 * k for k in range(1, 6)] if x < b]
    part("hatch_seam", "coaming", seams)
    part("house_lower", "house", [((-16.2, -6.9), (-3.7, 3.7), (1.8, 4.5))])
    part("house_middle", "house", [((-15.2, -7.6), (-3.3, 3.3), (4.5, 6.8))])
    part("bridge_wings", "house", [((-11.4, -8.6), (-4.6, 4.6), (6.8, 6.95))])
    part("wing_rail", "house", [((-11.4, -8.6), (s * 4.55 - 0.05, s * 4.55 + 0.05), (6.95, 7.9)) for s in (-1, 1)] +
         [((-8.7, -8.6), (min(s * 3.2, s * 4.6), max(s * 3.2, s * 4.6)), (6.95, 7.9)) for s in (-1, 1)])
    part("bridge", "house", [((-13.2, -8.3), (-3.1, 3.1), (6.8, 9.3)), ((-13.4, -7.9), (-3.3, 3.3), (9.3, 9.5))])
    panes = [((-8.30, -8.26), (-2.95 + 1.0 * k, -2.10 + 1.0 * k), (7.95, 8.95)) for k in range(6)]
    panes += [((-12.6 + 1.1 * k, -11.7 + 1.1 * k), (s * 3.10 - 0.04, s * 3.10 + 0.04), (7.95, 8.95)) for k in range(4) for s in (-1, 1)]
    panes += [((-7.60, -7.56), (-2.6 + 1.4 * k, -1.9 + 1.4 * k), (5.4, 6.1)) for k in range(4)]
    panes += [((-14.4 + 1.5 * k, -13.8 + 1.5 * k), (s * 3.30 - 0.04, s * 3.30 + 0.04), (5.4, 6.1)) for k in range(4) for s in (-1, 1)]
    panes += [((-15.6 + 1.6 * k, -15.0 + 1.6 * k), (s * 3.70 - 0.04, s * 3.70 + 0.04), (3.0, 3.6)) for k in range(5) for s in (-1, 1)]
    part("windows", "window", panes)
    part("funnel", "funnel", [((-15.9, -13.9), (-1.0, 1.0), (6.8, 9.6))], 0.15)
    part("funnel_top", "black", [((-15.7, -14.1), (-0.8, 0.8), (9.6, 10.4))], 0.05)
    part("mast_main", "mast", [((-11.5, -11.2), (-0.15, 0.15), (9.5, 13.2)), ((-11.4, -11.3), (-1.3, 1.3), (11.6, 11.72))], 0.04)
    part("radar", "house", [((-11.2, -11.0), (-1.2, 1.2), (12.2, 12.4))])
    part("mast_fore", "mast", [((14.4, 14.7), (-0.15, 0.15), (3.0, 8.6)), ((14.5, 14.6), (-0.7, 0.7), (7.2, 7.3))], 0.04)
    part("windlass", "coaming", [((13.0, 13.9), (-1.3, 1.3), (3.1, 3.7))])
    part("rescue_boat", "boat", [((-13.6, -10.2), (s * 4.0 - 0.55, s * 4.0 + 0.55), (4.6, 5.6)) for s in (-1, 1)], 0.3)
    part("davits", "house", [((x, x + 0.2), (min(s * 3.2, s * 4.2), max(s * 3.2, s * 4.2)), (5.6, 5.8)) for x in (-13.0, -11.0) for s in (-1, 1)])
    part("rudder", "antifouling", [((-17.3, -16.0), (-0.12, 0.12), (-2.6, -0.7))])


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    hull = Mesh()
    add_coaster_hull(hull)
    volume, low, high = check_hull(hull)
    hull.write(os.path.join(folder, "coaster_hull.obj"), "Coaster, watertight hull for physics; written by make_coaster.py", AXES)
    ship = Mesh()
    edge = add_coaster_hull(ship)
    add_bulwark(ship, edge)
    add_outfit(ship)
    ship.write(os.path.join(folder, "coaster.obj"), "Coaster, for drawing; written by make_coaster.py", AXES, "coaster.mtl")
    write_materials(os.path.join(folder, "coaster.mtl"),
                    "Colours of the coaster's parts, linear RGB; written by make_coaster.py", MATERIALS)
    print(f"hull: {len(hull.triangles())} triangles, {volume:.1f} m^3, from {low} to {high}")
    print(f"ship: {len(ship.triangles())} triangles")


main()
