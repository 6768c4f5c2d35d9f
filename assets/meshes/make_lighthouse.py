#!/usr/bin/env python3
"""Write the lighthouse's meshes: lighthouse_hull.obj (watertight, for physics) and lighthouse.obj + lighthouse.mtl (for
drawing).

An original rock lighthouse of 36 m: a plinth, a tower that narrows upwards, a gallery and a lantern. Axes: x, y level, z
up, z = 0 at the foot, on the sea bed or the rock; the plinth reaches 1 m below it. Metres. Every face is wound
counter-clockwise seen from outside.

    python3 make_lighthouse.py [FOLDER]

The script refuses to write a mesh for physics that is not closed or not outward.
"""
import math
import os
import sys

from mesh_writer import Mesh, add_revolution, check_closed, write_materials

AXES = "z up, z = 0 at the foot; metres."
SIDES = 48
BANDS = 5  # of red and white on the tower
TOWER_FOOT, TOWER_TOP = 5.0, 27.0  # m

MATERIALS = {  # name: diffuse colour, linear RGB
    "granite": (0.22, 0.21, 0.19),
    "red": (0.48, 0.03, 0.025),
    "white": (0.80, 0.79, 0.75),
    "rail": (0.10, 0.10, 0.10),
    "glass": (0.55, 0.58, 0.42),
    "dome": (0.30, 0.04, 0.035),
    "window": (0.012, 0.018, 0.024),
    "door": (0.04, 0.10, 0.06),
}


def tower_radius(z):
    """Concave, as Smeaton's tower: wide at the foot."""
    t = (z - TOWER_FOOT) / (TOWER_TOP - TOWER_FOOT)
    return 2.9 + 2.1 * (1.0 - t) ** 2.2


def outline():
    """[(radius, z, material of the band that ends there)] from the foot to the top."""
    points = [(0.0, -1.0, ""), (7.2, -1.0, "granite"), (6.8, 3.6, "granite"), (7.1, 3.8, "granite"), (7.1, 4.4, "granite"),
              (6.0, 5.0, "granite"), (tower_radius(TOWER_FOOT), TOWER_FOOT, "granite")]
    rows = 4 * BANDS
    for k in range(1, rows + 1):
        z = TOWER_FOOT + (TOWER_TOP - TOWER_FOOT) * k / rows
        points.append((tower_radius(z), z, "red" if (k - 1) // 4 % 2 == 0 else "white"))
    points += [(4.1, 28.0, "white"), (4.1, 28.4, "white"), (2.2, 28.4, "granite"), (2.2, 29.6, "white"),
               (2.0, 29.7, "white"), (2.0, 32.4, "glass"), (2.5, 32.5, "dome")]
    points += [(2.5 * math.cos(a), 32.5 + 2.0 * math.sin(a), "dome") for a in (0.35, 0.7, 1.05, 1.4)]
    return points + [(0.0, 35.0, "dome")]


def add_fittings(mesh):
    posts = [2.0 * math.pi * k / 24 for k in range(24)]
    mesh.part("rail_posts", "rail", [((3.95 * math.cos(a) - 0.05, 3.95 * math.cos(a) + 0.05),
                                      (3.95 * math.sin(a) - 0.05, 3.95 * math.sin(a) + 0.05), (28.4, 29.6)) for a in posts])
    for z in (29.0, 29.55):
        mesh.group("rail", "rail")
        rings = [[mesh.vertex(r * math.cos(a), r * math.sin(a), z + h) for a in posts]
                 for r, h in ((3.9, 0.0), (4.0, 0.0), (4.0, 0.06), (3.9, 0.06))]
        for low, high in zip(rings, rings[1:] + rings[:1]):
            for k in range(len(posts)):
                following = (k + 1) % len(posts)
                mesh.face(low[k], low[following], high[following], high[k])
    mullions = [2.0 * math.pi * k / 12 for k in range(12)]
    mesh.part("mullions", "rail", [((2.0 * math.cos(a) - 0.06, 2.0 * math.cos(a) + 0.06),
                                    (2.0 * math.sin(a) - 0.06, 2.0 * math.sin(a) + 0.06), (29.7, 32.5)) for a in mullions])
    windows = [((tower_radius(z) - 0.25, tower_radius(z) + 0.03), (-0.35, 0.35), (z, z + 1.3)) for z in (9.5, 14.5, 19.5, 24.0)]
    mesh.part("windows", "window", windows + [((-b, -a), y, z) for (a, b), y, z in windows])
    mesh.part("door", "door", [((4.4, tower_radius(5.0) + 0.05), (-0.6, 0.6), (5.0, 7.3))])
    mesh.part("lightning_rod", "rail", [((-0.06, 0.06), (-0.06, 0.06), (34.6, 36.8))])


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    hull = Mesh()
    add_revolution(hull, outline(), SIDES)
    volume, low, high = check_closed(hull)
    hull.write(os.path.join(folder, "lighthouse_hull.obj"),
               "Lighthouse, watertight, for physics; written by make_lighthouse.py", AXES)
    tower = Mesh()
    add_revolution(tower, outline(), SIDES)
    add_fittings(tower)
    tower.write(os.path.join(folder, "lighthouse.obj"), "Lighthouse, for drawing; written by make_lighthouse.py", AXES,
                "lighthouse.mtl")
    write_materials(os.path.join(folder, "lighthouse.mtl"),
                    "Colours of the lighthouse's parts, linear RGB; written by make_lighthouse.py", MATERIALS)
    print(f"for physics: {len(hull.triangles())} triangles, {volume:.1f} m^3, from {low} to {high}")
    print(f"for drawing: {len(tower.triangles())} triangles")


main()
