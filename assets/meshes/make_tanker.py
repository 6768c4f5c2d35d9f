#!/usr/bin/env python3
"""Write the tanker's meshes: tanker_hull.obj (watertight, for physics) and tanker.obj + tanker.mtl (for drawing).

An original coastal tanker of 64 m length, 11 m beam and 3.8 m draft, loaded. Body axes: x forward, y port, z up; the
origin is amidships on the design waterline (z = 0). Metres. Every face is wound counter-clockwise seen from outside.

    python3 make_tanker.py [FOLDER]

The script refuses to write a hull that is not closed, not outward or not of the size stated.
"""
import math
import os
import sys

from mesh_writer import Mesh, add_hull, add_plates, check_closed, mix, smoothstep, write_materials

AXES = "Body axes: x forward, y port, z up; z = 0 is the design waterline; metres."
LENGTH, BEAM, DRAFT = 64.0, 11.0, 3.8
BOOT_TOP = 0.35  # m, upper edge of the antifouling paint
STATIONS = 56
ROWS_BELOW, ROWS_ABOVE = 10, 4  # up to the paint's edge, and from there to the deck
FORECASTLE = int(0.86 * STATIONS)

MATERIALS = {  # name: diffuse colour, linear RGB
    "antifouling": (0.30, 0.035, 0.03),
    "topside": (0.012, 0.014, 0.018),
    "deck": (0.10, 0.20, 0.12),
    "trunk": (0.12, 0.24, 0.15),
    "pipe": (0.55, 0.55, 0.52),
    "valve": (0.60, 0.05, 0.03),
    "house": (0.80, 0.80, 0.76),
    "window": (0.012, 0.018, 0.024),
    "funnel": (0.05, 0.16, 0.35),
    "black": (0.02, 0.02, 0.022),
    "mast": (0.75, 0.73, 0.66),
    "boat": (0.75, 0.16, 0.02),
}


def deck_height(u):
    """Sheer line with a raised forecastle and a low poop; u from 0 (transom) to 1 (stem)."""
    return 1.45 + 0.9 * (1.0 - smoothstep(0.20, 0.24, u)) + 0.25 * u**3 + 1.5 * smoothstep(0.86, 0.90, u)


def keel_height(u):
    """Flat keel; the counter rises to the transom."""
    return -DRAFT + 3.1 * (1.0 - smoothstep(0.0, 0.15, u)) ** 1.2


def side_x(u, z):
    """Raked stem with a rounded forefoot; nearly upright transom."""
    above, below = 1.5 * max(z, 0.0) / 3.2, 1.2 * (min(z, 0.0) / -DRAFT) ** 2
    return mix(-LENGTH / 2, LENGTH / 2 - 1.5 + above - below, u)


def plan_form(u, height):
    """Half-breadth as a fraction of half the beam; height 0 at the bilge, 1 at the waterline, 2 at the deck."""
    waterline = (1.0 - max((u - 0.78) / 0.22, 0.0) ** 2.1) * mix(0.66, 1.0, smoothstep(0.0, 0.24, u))
    deck = (1.0 - max((u - 0.84) / 0.16, 0.0) ** 2.6) * mix(0.88, 1.0, smoothstep(0.0, 0.16, u))
    return mix(waterline, deck, min(max(height - 1.0, 0.0), 1.0) ** 1.3)


def section(u):
    """One side of a station, from the keel to the deck edge: [(half breadth, z)]."""
    fullness = 7.0 * smoothstep(0.02, 0.26, u) * (1.0 - smoothstep(0.76, 0.99, u)) + 1.4
    keel, deck = keel_height(u), deck_height(u)
    points = []
    for j in range(ROWS_BELOW + 1):
        angle = 0.5 * math.pi * j / ROWS_BELOW
        across = math.sin(angle) ** (2.0 / fullness) if j else 0.0
        up = 1.0 - math.cos(angle) ** (2.0 / fullness) if j < ROWS_BELOW else 1.0
        points.append((across * plan_form(u, up), mix(keel, BOOT_TOP, up)))
    for j in range(1, ROWS_ABOVE + 1):
        z = mix(BOOT_TOP, deck, j / ROWS_ABOVE)
        points.append((plan_form(u, 1.0 + (z - BOOT_TOP) / (deck - BOOT_TOP)), z))
    return [(0.5 * BEAM * across, z) for across, z in points]


def add_tanker_hull(mesh):
    bands = (("hull_bottom", "antifouling", 0, ROWS_BELOW),
             ("hull_topside", "topside", ROWS_BELOW, ROWS_BELOW + ROWS_ABOVE))
    return add_hull(mesh, STATIONS, section, side_x, bands, 0.02)


def both_sides(low, high):
    """The y of a pair of boxes, to port and to starboard."""
    return (low, high), (-high, -low)


def add_cargo_deck(part):
    part("trunk", "trunk", [((-17.0, 21.5), (-3.6, 3.6), (1.3, 2.35))], 0.12)
    part("tank_hatches", "house", [((x - 0.6, x + 0.6), y, (2.35, 2.95))
                                   for x in range(-14, 21, 7) for y in both_sides(1.5, 2.7)], 0.05)
    lines = [((-15.5, 20.5), (y - 0.14, y + 0.14), (2.75, 3.03)) for y in (-0.75, -0.25, 0.25, 0.75)]
    part("pipelines", "pipe", lines + [((x - 0.1, x + 0.1), (-1.0, 1.0), (2.35, 2.75)) for x in range(-15, 21, 3)])
    manifold = [((x - 0.14, x + 0.14), (-4.9, 4.9), (3.03, 3.31)) for x in (1.0, 1.9, 2.8, 3.7)]
    part("manifold", "pipe", manifold + [((0.4, 4.3), y, (1.6, 3.03)) for y in both_sides(4.2, 4.5)])
    part("valves", "valve", [((x - 0.22, x + 0.22), y, (2.95, 3.6)) for x in (1.0, 1.9, 2.8, 3.7) for y in both_sides(3.4, 3.7)])
    part("crane_post", "mast", [((5.6, 6.2), (-0.3, 0.3), (2.3, 7.4))], 0.06)
    part("crane_jib", "mast", [((6.0, 13.5), (-0.15, 0.15), (7.0, 7.35))])
    rails = [((x - 0.03, x + 0.03), y, (1.45, 2.5)) for x in [-17.0 + 1.95 * k for k in range(21)] for y in both_sides(5.25, 5.31)]
    bars = [((-17.0, 22.0), y, (z, z + 0.05)) for z in (1.95, 2.45) for y in both_sides(5.25, 5.31)]
    part("rails", "mast", rails + bars)


def add_house(part):
    part("house", "house", [((-29.0, -18.5), (-4.7, 4.7), (2.2, 4.9)), ((-28.0, -19.0), (-4.2, 4.2), (4.9, 7.4)),
                            ((-27.0, -19.4), (-3.9, 3.9), (7.4, 9.9))])
    part("bridge", "house", [((-24.5, -19.6), (-3.6, 3.6), (9.9, 12.3)), ((-24.8, -19.2), (-3.9, 3.9), (12.3, 12.5))])
    part("bridge_wings", "house", [((-22.6, -19.4), (-5.5, 5.5), (9.75, 9.9))] +
         [((-22.6, -19.4), y, (9.9, 10.9)) for y in both_sides(5.4, 5.5)] +
         [((-19.5, -19.4), y, (9.9, 10.9)) for y in both_sides(3.6, 5.5)])
    panes = [((-19.60, -19.56), (-3.4 + 1.0 * k, -2.6 + 1.0 * k), (10.9, 12.0)) for k in range(7)]
    panes += [((-24.0 + 1.1 * k, -23.1 + 1.1 * k), y, (10.9, 12.0)) for k in range(4) for y in both_sides(3.56, 3.64)]
    for front, side, z in ((-18.5, 4.7, 3.3), (-19.0, 4.2, 5.8), (-19.4, 3.9, 8.3)):
        panes += [((front - 0.02, front + 0.04), (-3.3 + 1.5 * k, -2.7 + 1.5 * k), (z, z + 0.7)) for k in range(5)]
        panes += [((-27.0 + 1.6 * k, -26.4 + 1.6 * k), y, (z, z + 0.7)) for k in range(5) for y in both_sides(side - 0.04, side + 0.04)]
    part("windows", "window", panes)
    part("funnel", "funnel", [((-28.2, -25.4), (-1.4, 1.4), (7.4, 12.2))], 0.2)
    part("funnel_top", "black", [((-27.8, -25.8), (-1.0, 1.0), (12.2, 13.0))], 0.05)
    part("main_mast", "mast", [((-22.4, -22.0), (-0.2, 0.2), (12.5, 17.0)), ((-22.3, -22.1), (-1.6, 1.6), (15.2, 15.35))], 0.05)
    part("radar", "house", [((-22.0, -21.75), (-1.5, 1.5), (15.6, 15.85))])
    part("lifeboats", "boat", [((-27.0, -22.4), y, (5.6, 6.9)) for y in both_sides(4.3, 5.4)], 0.35)


def add_ends(part):
    part("fore_mast", "mast", [((26.6, 27.0), (-0.2, 0.2), (3.1, 10.2)), ((26.75, 26.85), (-0.9, 0.9), (8.6, 8.7))], 0.05)
    part("windlass", "pipe", [((24.9, 26.1), (-1.8, 1.8), (3.1, 3.9))])
    part("winches", "pipe", [((-31.0, -30.0), y, (2.3, 3.0)) for y in both_sides(1.2, 3.0)])
    part("rudder", "antifouling", [((-30.9, -29.0), (-0.16, 0.16), (-3.5, -0.9))])


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    hull = Mesh()
    add_tanker_hull(hull)
    volume, low, high = check_closed(hull)
    assert abs(high[0] - low[0] - LENGTH) < 0.6 and abs(high[1] - low[1] - BEAM) < 0.05 and abs(low[2] + DRAFT) < 0.01
    hull.write(os.path.join(folder, "tanker_hull.obj"), "Tanker, watertight hull for physics; written by make_tanker.py", AXES)
    ship = Mesh()
    edge = add_tanker_hull(ship)
    add_plates(ship, edge, (("bulwark", "topside", FORECASTLE, STATIONS, 1.0), ("gunwale", "topside", 0, FORECASTLE, 0.15)))
    for add in (add_cargo_deck, add_house, add_ends):
        add(ship.part)
    ship.write(os.path.join(folder, "tanker.obj"), "Tanker, for drawing; written by make_tanker.py", AXES, "tanker.mtl")
    write_materials(os.path.join(folder, "tanker.mtl"), "Colours of the tanker's parts, linear RGB; written by make_tanker.py", MATERIALS)
    print(f"hull: {len(hull.triangles())} triangles, {volume:.1f} m^3, from {low} to {high}")
    print(f"ship: {len(ship.triangles())} triangles")


main()
