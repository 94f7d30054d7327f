"""What parts are put together from. z is up; lengths in millimetres, angles in radians."""
import math

import cadquery as cq
import numpy as np

W = cq.Workplane


def disc(r, h, z=0.0, x=0.0, y=0.0):
    """A cylinder along z, the centre of its base at (x, y, z)."""
    return W("XY", origin=(x, y, z)).circle(r).extrude(h)


def turned(*profile):
    """A body of revolution round z from (r, z) points."""
    return W("XZ").polyline(profile).close().revolve(360, (0, 0, 0), (0, 1, 0))


def around(body, count, step=None):
    """Copies of a body turned round z, as a list."""
    return [body.rotate((0, 0, 0), (0, 0, 1), (step or 360 / count) * k) for k in range(count)]


def joined(body, others):
    for other in others:
        body = body.union(other)
    return body


def less(body, others):
    for other in others:
        body = body.cut(other)
    return body


def radial(r, angle):
    return r * math.cos(angle), r * math.sin(angle)


def toothed_wire(z, teeth, root, tip, half_root, half_tip, bulge, turn=0.0, points=5):
    """A closed wire of spline flanks, tip and root arcs; angles as shares of the pitch."""
    pitch, edges = 2 * math.pi / teeth, []
    at = lambda r, angle: cq.Vector(*radial(r, angle), z)
    for k in range(teeth):
        middle = k * pitch + turn
        flank = [(root + (tip - root) * s, half_root + (half_tip - half_root) * (s + bulge * s * (1 - s) * (1 + s))) for s in np.linspace(0, 1, points)]
        left = [at(r, middle - a * pitch) for r, a in flank]
        right = [at(r, middle + a * pitch) for r, a in reversed(flank)]
        edges += [cq.Edge.makeSpline(left), cq.Edge.makeThreePointArc(left[-1], at(tip, middle), right[0]), cq.Edge.makeSpline(right),
                  cq.Edge.makeThreePointArc(right[-1], at(root, middle + pitch / 2), at(root, middle + pitch - half_root * pitch))]
    return cq.Wire.assembleEdges(edges)


def airfoil(chord, thick, camber, angle, x, y, z):
    """A closed wire: two splines from a blunt trailing edge round a nose."""
    t = np.linspace(0, 1, 9)
    half = thick * (1.48 * np.sqrt(t) - 0.63 * t - 1.758 * t ** 2 + 1.4215 * t ** 3 - 0.5 * t ** 4)
    line = 4 * camber * t * (1 - t)
    c, s = math.cos(angle), math.sin(angle)
    spot = lambda u, v: cq.Vector(x + chord * (c * (u - 0.4) - s * v), y + chord * (s * (u - 0.4) + c * v), z)
    upper = [spot(u, v) for u, v in zip(t, line + half)][::-1]
    lower = [spot(u, v) for u, v in zip(t, line - half)]
    return cq.Wire.assembleEdges([cq.Edge.makeSpline(upper + lower[1:]), cq.Edge.makeLine(lower[-1], upper[0])])
