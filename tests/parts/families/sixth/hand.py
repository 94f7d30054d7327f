"""What hands hold and swing: spines, lofts and grips."""
import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..second.outlines import lying
from ..shapes import W, disc, turned, less
from ..third.sections import closed_curve, lofted, squarish


def spine(*points, tangents):
    """A spline in the plane of x and z."""
    return cq.Edge.makeSpline([cq.Vector(x, 0, z) for x, z in points], tangents=[cq.Vector(x, 0, z) for x, z in tangents])


@part(turn=True, offset=1.0)
def razor_handle():
    path = spine((-60, 4), (-20, -2), (20, 5), (52, 14), tangents=((1, -0.3), (1, 0.5)))
    body = swept_ellipses(path, ((0, 5.5, 4), (0.25, 7.5, 5), (0.55, 6, 4.5), (0.8, 5, 4), (1, 3.6, 3)))
    head = W().box(11, 40, 5).edges("|Y").edges(">X").fillet(2).rotate((0, 0, 0), (0, 1, 0), 25).translate((54.5, 0, 16.5))
    blades = [W().box(1.2, 36, 6).rotate((0, 0, 0), (0, 1, 0), 25).translate((52.5 + x, 0, 19.5 - 0.47 * x)) for x in (-2, 1, 4)]
    body = body.union(less(head, blades))
    return body.cut(W("XZ", origin=(-52, 0, 3)).circle(1.8).extrude(40, both=True))


@part(turn=True, offset=1.0)
def golf_driver_head():
    rows = ((0, -2, 24, 34, 2.2), (7, 0, 33, 46, 2.3), (20, 1, 36, 50, 2.3), (32, -2, 30, 42, 2.2), (40, -6, 17, 26, 2.1))
    body = lofted([closed_curve(squarish(a, b, p), cq.Plane((x, 0, z)), 32) for z, x, a, b, p in rows])
    face = W().box(40, 140, 90).translate((20, 0, 0)).rotate((0, 0, 0), (0, 1, 0), -10).translate((27, 0, 20))
    body = body.cut(face)
    hosel = turned((0, -26), (6, -26), (6, 30), (5.5, 31), (0, 31)).rotate((0, 0, 0), (1, 0, 0), -24).translate((12, 34, 44))
    bore = disc(4.2, 60, 0).rotate((0, 0, 0), (1, 0, 0), -24).translate((12, 34, 44))
    body = body.union(hosel).cut(bore)
    grooves = [W().box(1, 34 + 4 * (k % 2), 1).rotate((0, 0, 0), (0, 1, 0), -10).translate((27 - 0.176 * (z - 20), 0, z)) for k, z in enumerate((12, 17, 22, 27))]
    return less(body, grooves).cut(disc(6, 3, -1, -16)).cut(disc(2, 9, -1, -16))


@part(turn=True, offset=1.0)
def canoe_paddle():
    rows = ((0, 12, 3.4), (30, 19, 4), (70, 24, 3.6), (110, 22, 2.8), (138, 13, 2))
    blade = lofted([closed_curve(squarish(b, a, 2.0 + 0.2 * k), cq.Plane((x, 0, 3e-4 * x * x), (0, 1, 0), (1, 0, 0)), 28) for k, (x, a, b) in enumerate(rows)])
    path = W("YZ", origin=(-110, 0, 0))
    body = blade.union(path.circle(6).extrude(114)).union(lying(turned((0, 0), (7.5, 0), (7.5, 12), (6, 15), (0, 15)), "+x").translate((-6, 0, 0)))
    grip = W("XZ", origin=(-112, 26, 0)).circle(6.5).extrude(52)
    body = body.union(grip).union(W().sphere(6.5).translate((-112, 26, 0))).union(W().sphere(6.5).translate((-112, -26, 0)))
    return body.cut(W("XY", origin=(-80, 0, -20)).circle(1.8).extrude(40))
