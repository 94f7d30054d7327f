"""Plain closed forms: one to seven faces, some of them small, large or far from the origin."""
import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned


@part(turn=True, offset=3.0, scale=40)
def slab():
    return W().box(9, 4, 1)


@part(turn=True, offset=1.0)
def tetrahedron():
    corners = [cq.Vector(*q) for q in ((10, 10, 10), (10, -10, -10), (-10, 10, -10), (-10, -10, 10))]
    triangle = lambda a, b, c: cq.Face.makeFromWires(cq.Wire.makePolygon([corners[k] for k in (a, b, c)], close=True))
    return W(obj=cq.Solid.makeSolid(cq.Shell.makeShell([triangle(0, 1, 2), triangle(0, 3, 1), triangle(0, 2, 3), triangle(1, 3, 2)])))


@part(offset=5.0, scale=0.1)
def coin():
    return disc(12, 1.9)


@part(turn=True, offset=1.0)
def frustum():
    return turned((0, 0), (20, 0), (13, 31), (0, 31))


@part(turn=True, offset=4.0, scale=8)
def far_ball():
    return W().sphere(7)


@part(turn=True, offset=1.0)
def thin_ring():
    return W(obj=cq.Solid.makeTorus(30, 1.4))


@part(turn=True, offset=1.0, scale=0.02)
def capsule():
    return disc(6, 26).union(W().sphere(6)).union(W().sphere(6).translate((0, 0, 26)))


@part(turn=True)
def plano_convex():
    return W().sphere(52).translate((0, 0, -44)).intersect(disc(24, 40))


@part(turn=True, offset=0.5, scale=5)
def bent_rod():
    return W("XY", origin=(18, 0, 0)).circle(3).revolve(215, (-18, 0, 0), (-18, -1, 0))


@part(turn=True, offset=2.0)
def wedge():
    return W("XZ").polyline([(0, 0), (44, 0), (44, 3), (6, 18), (0, 18)]).close().extrude(13, both=True)
