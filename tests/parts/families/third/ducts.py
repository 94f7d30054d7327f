"""Ducts, manifolds and pipes of changing section."""
import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, joined, less
from .sections import closed_curve, lofted, squarish


@part(turn=True)
def exhaust_header():
    flange = W().box(86, 40, 6, centered=(True, True, False)).edges("|Z").fillet(10)
    runner = lambda x: cq.Edge.makeSpline([cq.Vector(x, 0, 2), cq.Vector(x * 0.92, 6, 22), cq.Vector(x * 0.55, 20, 44), cq.Vector(x * 0.46, 24, 66)],
                                           tangents=[cq.Vector(0, 0, 1), cq.Vector(0, 0, 1)])
    pipes = [W("XY", origin=(x, 0, 2)).circle(9.5).sweep(W(obj=runner(x))) for x in (-26, 26)]
    bores = [W("XY", origin=(x, 0, 2)).circle(7.5).sweep(W(obj=runner(x))) for x in (-26, 26)]
    body = joined(flange, pipes).union(W("XY", origin=(0, 24, 64)).slot2D(54, 28).extrude(22).faces(">Z or <Z").edges().chamfer(1.5))
    body = less(body, bores + [disc(7.5, 10, -8, x) for x in (-26, 26)]).cut(W("XY", origin=(0, 24, 66)).slot2D(46, 20).extrude(16)).cut(disc(9, 40, 66, 0, 24))
    return less(body, [disc(3, 20, -5, x, y) for x in (-37, 0, 37) for y in (-14, 14) if x])


@part(turn=True)
def air_nozzle():
    rows = ((0, 12, 12, 2.0), (18, 15, 10, 2.2), (40, 24, 6, 2.8), (58, 30, 4, 3.2))
    def solid(thin, grow):
        wall = lambda z: thin * (1 if z < 20 else 0.7)
        return lofted([closed_curve(squarish(a - thin, b - wall(z), p), cq.Plane((0, 0, z + grow * (z - 29) / 29)), 32) for z, a, b, p in rows])
    body = solid(0, 0).union(turned((0, -18), (15, -18), (16, -17), (16, 5), (15, 6), (0, 6)))
    body = body.cut(solid(2, 0.5)).cut(turned((0, -20), (10.5, -20), (10.5, -3), (9, -1), (9, 0.4), (0, 0.4)))
    clip = W().box(7, 4, 12).translate((0, 16.5, -8)).edges("|X").edges(">Y").chamfer(1.5)
    return body.union(clip)


@part(turn=True, offset=0.5)
def twin_pipe_saddle():
    path = cq.Edge.makeSpline([cq.Vector(-40, -12, 0), cq.Vector(-18, -4, 5), cq.Vector(14, 10, 4), cq.Vector(40, 12, 0)],
                              tangents=[cq.Vector(1, 0, 0), cq.Vector(1, 0, 0)])
    tube = W("YZ", origin=(-40, -12, 0)).circle(6).sweep(W(obj=path))
    body = tube.union(W("YZ", origin=(-46, -12, 0)).circle(8).extrude(9)).union(W("YZ", origin=(37, 12, 0)).circle(8).extrude(9))
    body = body.union(W().box(22, 34, 12).translate((0, 1, -3)).edges("|Z").fillet(5)).cut(W("YZ", origin=(-40, -12, 0)).circle(4).sweep(W(obj=path)))
    body = body.cut(W("YZ", origin=(-50, -12, 0)).circle(4).extrude(10.01)).cut(W("YZ", origin=(39.99, 12, 0)).circle(4).extrude(20))
    return less(body, [disc(1.8, 40, -20, x, y) for x, y in ((6, -11), (-6, 13))])
