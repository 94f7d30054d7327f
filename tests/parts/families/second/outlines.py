"""What parts of the second series are put together from, besides `shapes`."""
import math

import cadquery as cq
from OCP.gp import gp_Pnt2d
from OCP.TColgp import TColgp_Array1OfPnt2d

from ..shapes import W, disc, turned

inside = cq.selectors.BoxSelector  # picks what has its centre in a box
nearest = cq.selectors.NearestToPointSelector


def link(r1, r2, length, h, z=0.0):
    """A plate of height h: two discs, the second at x = length, and their common tangents."""
    c = (r1 - r2) / length
    s = math.sqrt(1 - c * c)
    hull = [(r1 * c, r1 * s), (length + r2 * c, r2 * s), (length + r2 * c, -r2 * s), (r1 * c, -r1 * s)]
    return W("XY", origin=(0, 0, z)).polyline(hull).close().extrude(h).union(disc(r1, h, z)).union(disc(r2, h, z, length))


def countersink(r, head, depth):
    """A tool that drills down from z = 0, its 90 degree countersink as wide as the head."""
    return turned((0, -depth), (r, -depth), (r, r - head), (head + 0.01, 0.01), (0, 0.01))


def counterbore(r, head, deep, depth):
    """The same with a flat seat for the head."""
    return turned((0, -depth), (r, -depth), (r, -deep), (head, -deep), (head, 0.01), (0, 0.01))


def lying(body, axis):
    """A tool that works down from z = 0, turned to work inward against +x, -x, +y or -y."""
    about, angle = {"+x": ((0, 1, 0), 90), "-x": ((0, 1, 0), -90), "+y": ((1, 0, 0), -90), "-y": ((1, 0, 0), 90)}[axis]
    return body.rotate((0, 0, 0), about, angle)


def sheet(points, thick, radius, width):
    """A strip bent round y: the path of its middle in x and z, the inner radius of its bends."""
    ways = [(x2 - x1, z2 - z1) for (x1, z1), (x2, z2) in zip(points, points[1:])]
    ways = [(x / math.hypot(x, z), z / math.hypot(x, z)) for x, z in ways]
    left, right = [], []
    for k, (x, z) in enumerate(points):
        before, after = ways[max(k - 1, 0)], ways[min(k, len(ways) - 1)]
        nx, nz = -(before[1] + after[1]), before[0] + after[0]
        scale = thick / (nx * -before[1] + nz * before[0]) / 2
        left.append((x + scale * nx, z + scale * nz))
        right.append((x - scale * nx, z - scale * nz))
    body = W("XZ").polyline(left + right[::-1]).close().extrude(width / 2, both=True)
    for k in range(1, len(points) - 1):
        to_left = ways[k - 1][0] * ways[k][1] - ways[k - 1][1] * ways[k][0] > 0
        for (x, z), r in ((left[k], radius if to_left else radius + thick), (right[k], radius + thick if to_left else radius)):
            body = body.edges("|Y").edges(nearest((x, 0, z))).fillet(r)
    return body


def rounded_rect(w, h, r, depth, taper=0.0):
    """A plate or a drafted block with rounded corners, upward from z = 0; downward for a negative depth."""
    return W().sketch().rect(w, h).vertices().fillet(r).finalize().extrude(depth, taper=taper)


def swelling(tool, edge, radii):
    """Adds a fillet of variable radius: its radii at equal steps along the edge."""
    law = TColgp_Array1OfPnt2d(1, len(radii))
    for k, r in enumerate(radii):
        law.SetValue(k + 1, gp_Pnt2d(k / (len(radii) - 1), r))
    tool.Add(law, edge.wrapped)
