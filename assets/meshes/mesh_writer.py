"""What the scripts that write meshes share: a mesh of named parts with materials, ships' hulls from stations, bodies of
revolution, and the checks that a mesh for physics must pass. Body axes: x forward, y port, z up; metres; faces wound
counter-clockwise seen from outside.
"""
import math


def smoothstep(a, b, x):
    t = min(max((x - a) / (b - a), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def mix(a, b, t):
    return a + (b - a) * t


class Mesh:
    def __init__(self):
        self.vertices, self.groups = [], []

    def group(self, name, material):
        self.groups.append((name, material, []))

    def vertex(self, x, y, z):
        self.vertices.append((x, y, z))
        return len(self.vertices)

    def face(self, *indices):
        unique = [v for k, v in enumerate(indices) if v != indices[k - 1]]
        for k in range(1, len(unique) - 1):
            self.groups[-1][2].append((unique[0], unique[k], unique[k + 1]))

    def box(self, x, y, z, taper=0.0):
        """Axis-aligned box from three (low, high) pairs; the top shrinks by `taper` on each side."""
        v = [self.vertex(x[i] + (taper if k and not i else -taper if k else 0.0),
                         y[j] + (taper if k and not j else -taper if k else 0.0), z[k])
             for k in (0, 1) for j in (0, 1) for i in (0, 1)]
        for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            self.face(v[a], v[b], v[c], v[d])

    def part(self, name, material, boxes, taper=0.0):
        self.group(name, material)
        for x, y, z in boxes:
            self.box(x, y, z, taper)

    def triangles(self):
        return [t for _, _, triangles in self.groups for t in triangles]

    def write(self, path, title, axes, material_file=None):
        with open(path, "w", encoding="ascii") as out:
            out.write(f"# {title}\n# {axes}\n")
            if material_file:
                out.write(f"mtllib {material_file}\n")
            out.writelines("v {:.4f} {:.4f} {:.4f}\n".format(*v) for v in self.vertices)
            for name, material, triangles in self.groups:
                out.write(f"g {name}\n" + (f"usemtl {material}\n" if material_file else ""))
                out.writelines("f {} {} {}\n".format(*t) for t in triangles)


def write_materials(path, title, materials):
    """@param materials  name: diffuse colour, linear RGB"""
    with open(path, "w", encoding="ascii") as out:
        out.write(f"# {title}\n")
        out.writelines("newmtl {}\nKd {} {} {}\n".format(name, *colour) for name, colour in materials.items())


def add_hull(mesh, stations, section, side_x, bands, camber):
    """The closed hull of a ship from its stations; returns the deck edge of the port side.

    section(u): one side of the station at u (0 transom, 1 stem), from the keel to the deck edge: [(half breadth, z)];
    side_x(u, z): where it stands; bands: (name, material, first row, last row); camber: rise of the deck's middle as a
    part of the half breadth."""
    port, starboard = [], []
    for i in range(stations + 1):
        u = 0.5 * (1.0 - math.cos(math.pi * i / stations)) * 0.35 + 0.65 * i / stations
        side = [(side_x(u, z), y if i < stations else 0.0, z) for y, z in section(u)]
        port.append([mesh.vertex(*p) for p in side])
        starboard.append([port[-1][j] if p[1] == 0.0 else mesh.vertex(p[0], -p[1], p[2]) for j, p in enumerate(side)])
    rows = len(port[0]) - 1
    edge = [mesh.vertices[side[rows] - 1] for side in port]
    centre = [mesh.vertex(x, 0.0, z + camber * y) for x, y, z in edge[:-1]] + [port[-1][rows]]
    for name, material, first, last in bands:
        mesh.group(name, material)
        for j in range(first, last):
            for i in range(stations):
                mesh.face(port[i][j + 1], port[i + 1][j + 1], port[i + 1][j], port[i][j])
                mesh.face(starboard[i + 1][j], starboard[i + 1][j + 1], starboard[i][j + 1], starboard[i][j])
            top = (starboard[0][j + 1], centre[0], port[0][j + 1]) if j + 1 == rows else (starboard[0][j + 1], port[0][j + 1])
            mesh.face(starboard[0][j], *top, port[0][j])
    mesh.group("hull_deck", "deck")
    for i in range(stations):
        mesh.face(centre[i], centre[i + 1], port[i + 1][rows], port[i][rows])
        mesh.face(centre[i], starboard[i][rows], starboard[i + 1][rows], centre[i + 1])
    return edge


def add_plates(mesh, edge, plates):
    """Thin plates that stand on a stretch of the deck edge: (name, material, first, last, height) in stations."""
    for name, material, first, last, height in plates:
        mesh.group(name, material)
        for side in (1.0, -1.0):
            outer = [(x, side * y, z) for x, y, z in edge[first:last + 1]]
            inner = [(x - (0.15 if y == 0.0 else 0.0), side * max(abs(y) - 0.12, 0.0), z) for x, y, z in outer]
            rings = []
            for o, n in zip(outer, inner):
                rings.append([mesh.vertex(*o), mesh.vertex(o[0], o[1], o[2] + height),
                              mesh.vertex(n[0], n[1], n[2] + height), mesh.vertex(*n)])
            for a, b in zip(rings, rings[1:]):
                for k in range(3):
                    quad = (a[k], a[k + 1], b[k + 1], b[k])
                    mesh.face(*(quad if side > 0 else quad[::-1]))


def add_revolution(mesh, outline, sides, centre=(0.0, 0.0)):
    """Turns an outline about a vertical axis: [(radius, z, material of the band that ends there)], upwards, its first
    and last radius 0."""
    x, y = centre
    rings = []
    for radius, z, _ in outline:
        angles = [2.0 * math.pi * k / sides for k in range(sides)] if radius > 0.0 else []
        rings.append([mesh.vertex(x + radius * math.cos(a), y + radius * math.sin(a), z) for a in angles] or
                     [mesh.vertex(x, y, z)] * sides)
    for k in range(1, len(outline)):
        mesh.group(f"band_{k}", outline[k][2])
        low, high = rings[k - 1], rings[k]
        for side in range(sides):
            following = (side + 1) % sides
            mesh.face(low[side], low[following], high[following], high[side])


def check_closed(mesh):
    """Every edge once in each direction, positive volume; returns the volume and the corners of the box around."""
    edges = set()
    for a, b, c in mesh.triangles():
        for edge in ((a, b), (b, c), (c, a)):
            assert edge not in edges, f"edge {edge} twice in one direction"
            edges.add(edge)
    assert all((b, a) in edges for a, b in edges), "the mesh is open"
    volume = 0.0
    for a, b, c in (tuple(mesh.vertices[k - 1] for k in t) for t in mesh.triangles()):
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0
    assert volume > 0.0, "faces point inward"
    low = [min(v[k] for v in mesh.vertices) for k in range(3)]
    high = [max(v[k] for v in mesh.vertices) for k in range(3)]
    return volume, low, high
