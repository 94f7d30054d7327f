"""Things that lift, pull and hold."""
import cadquery as cq

from ..register import part
from ..second.outlines import lying, nearest
from ..shapes import W, disc, turned, joined, less
from .profiles import round_body


def ring(r, wire, angle=360):
    """A ring of round wire in the plane of x and y, or what of it begins at +x and turns by an angle."""
    return W("XZ", origin=(r, 0, 0)).circle(wire).revolve(angle, (-r, 0, 0), (-r, 1, 0))


@part(uniform=False, turn=True, offset=1.0, scale=1.5)  # gmsh cannot close the edges of the ring
def eye_bolt():
    body = ring(17, 5.5).rotate((0, 0, 0), (1, 0, 0), 90).translate((0, 0, 31))
    base = round_body((0, -30), (5.2, -30), (6, -29), (6, -3), (5, -3), (5, 0), (15, 0), (15, 3, 2), (4.6, 5, 3), (4.6, 13), (0, 13))
    return body.union(base)


@part(turn=True, offset=0.5)
def turnbuckle():
    frame = joined(W("YZ", origin=(-36, 9, 0)).circle(3.4).extrude(72), [W("YZ", origin=(-36, -9, 0)).circle(3.4).extrude(72)])
    boss = lying(turned((0, 0), (8.5, 0), (8.5, 12), (6.5, 15), (0, 15)), "+x")
    cheek = W("YZ").slot2D(26, 10).extrude(11)
    body = joined(frame, [boss.translate((31, 0, 0)), cheek.translate((31, 0, 0)), boss.mirror("YZ").translate((-31, 0, 0)), cheek.mirror("YZ").translate((-31, 0, 0))])
    body = body.union(W("YZ", origin=(18, 0, 0)).circle(4).extrude(44)).union(ring(8.5, 3.4).translate((70, 0, 0)))
    hook = ring(8.5, 3.4, 250).translate((-69, 0, 0))
    body = body.union(W("YZ", origin=(-62, 0, 0)).circle(4).extrude(44)).union(hook)
    return body.cut(W("XZ", origin=(20.5, 0, 0)).circle(1).extrude(20, both=True))


@part(turn=True)
def taper_arbor():
    body = turned((0, 0), (6.4, 0), (7, 0.8), (8.9, 66), (8.9, 70), (7.6, 71), (7.6, 75), (10.5, 75.5), (10.5, 80), (8.6, 81), (7.8, 99), (7, 100), (0, 100))
    tang = W().box(30, 30, 12).translate((19, 0, 6))
    body = body.union(disc(4.5, 4, -3)).cut(tang).cut(tang.mirror("YZ"))
    body = less(body, [W("YZ", origin=(0, y, 12)).circle(3).extrude(30, both=True) for y in (-19, 19)])
    body = body.cut(turned((0, 92), (1.5, 95), (1.5, 97), (4, 100.01), (0, 100.01))).cut(turned((8.1, 40), (9, 39), (9, 42), (8.1, 41)))
    return less(body, [W().box(5, 30, 3).translate((s * 11, 0, 77.7)) for s in (-1, 1)])


@part(turn=True, offset=1.0)
def frame_lug():
    down = disc(17, 72, -34).rotate((0, 0, 0), (0, 0, 1), 180)  # the seam away from the crossing
    lean = lambda r, start, long: W(cq.Plane((0, 0, 0), (0, 1, 0), (1, 0, 0.5))).workplane(offset=start).circle(r).extrude(long)
    body = down.union(lean(14.5, 0, 52)).edges(nearest((13, 0, 7.5))).fillet(4)
    ears = W().box(14, 15, 20).translate((-21, 0, 26)).edges("|Y").edges("<X").fillet(6)
    body = body.union(ears).cut(disc(15, 120, -60)).cut(lean(12.5, 0, 80)).cut(W().box(20, 2, 44).translate((-22, 0, 30)))
    body = body.cut(W("XZ", origin=(-23, 0, 26)).circle(2.6).extrude(40, both=True))
    scallop = W("YZ", origin=(0, 0, -36)).circle(9).extrude(40, both=True)
    return body.cut(scallop).cut(W("XZ", origin=(0, 0, -20)).circle(3.2).extrude(40))
