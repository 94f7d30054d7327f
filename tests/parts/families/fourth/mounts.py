"""Hangers, supports, feet and holders."""
from ..register import part
from ..second.outlines import countersink, inside, link, lying, nearest
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def pipe_hanger():
    ring = W("XZ").circle(23).circle(19).extrude(9, both=True).cut(W().box(80, 40, 40).translate((0, 0, 26)))
    sides = [W().box(4, 18, 40, centered=(True, True, False)).translate((x, 0, 0)) for x in (-21, 21)]
    body = joined(ring, sides).union(W().box(46, 18, 5, centered=(True, True, False)).translate((0, 0, 36)))
    body = body.edges("|Y").edges(nearest((23, 0, 41))).fillet(5).edges("|Y").edges(nearest((-23, 0, 41))).fillet(5)
    body = body.union(turned((0, 36), (6.6, 36), (6.6, 48), (5.6, 49), (0, 49)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 40.9), (1, 1, 41.1))).fillet(1.8)
    body = body.cut(disc(4.2, 40, 30)).cut(W("YZ", origin=(0, 0, 26)).circle(2.7).extrude(40, both=True))
    return body.cut(disc(2, 12, -28))


@part(turn=True)
def shelf_support():
    body = W().box(22, 6, 150, centered=(True, False, False)).edges("|Y").fillet(10.5)
    arm = W("YZ").polyline([(3, 112), (120, 128), (120, 136), (3, 136)]).close().extrude(5, both=True)
    strut = W("YZ").moveTo(3, 40).threePointArc((35, 92), (88, 125)).lineTo(80, 131).threePointArc((28, 96), (3, 54)).close().extrude(3, both=True)
    body = joined(body, [arm, strut])
    body = body.union(W().box(28, 112, 4, centered=(True, False, False)).translate((0, 6, 134)).edges("|Z").edges(">Y").fillet(9))
    body = less(body, [lying(countersink(2.6, 5, 30), "+y").translate((0, 6, z)) for z in (14, 30)])
    return less(body, [disc(2.2, 40, 120, x, y) for x in (-9, 9) for y in (36, 92)])


@part(turn=True, offset=0.5)
def levelling_foot():
    body = turned((0, 0), (24, 0), (26, 3), (26, 5), (11, 11), (0, 11)).union(W().sphere(8).translate((0, 0, 13)))
    body = body.union(disc(4.5, 62, 13)).union(W("XY", origin=(0, 0, 34)).polygon(6, 15).extrude(6))
    body = body.faces(">Z").edges().chamfer(1)
    body = less(body, [turned((3.9, z), (5, z - 0.5), (5, z + 0.5)) for z in (48, 52, 56, 60, 64, 68)])
    body = body.cut(turned((0, -1), (21, -1), (21, 1.5), (0, 1.5)))
    return less(body, around(disc(1.7, 30, -5, 19), 3))


@part(turn=True, offset=2.0)
def mirror_mount():
    frame = W("XZ").rect(50, 50).extrude(8).edges("|Y").chamfer(3).cut(W("XZ").rect(36, 36).extrude(8).translate((9, 0, 9)))
    ring = W("XZ").rect(46, 46).extrude(9).edges("|Y").fillet(4).translate((0, 14, 0))
    ring = ring.cut(W("XZ", origin=(0, 30, 0)).circle(15).extrude(60)).cut(W("XZ", origin=(0, 9, 0)).circle(17).extrude(5.5))
    pins = [lying(turned((0, -12), (3, -12), (3, 16), (4.5, 16), (4.5, 24), (3.8, 24.7), (0, 24.7)), "-y").translate((x, 0, z)) for x, z in ((-18, -18), (-18, 18), (18, -18))]
    body = joined(frame, [ring] + pins)
    body = less(body, [lying(turned((0, -2), (1.5, -2), (1.5, 1), (0, 1)), "-y").translate((x, -24.7, z)) for x, z in ((-18, -18), (-18, 18), (18, -18))])
    body = body.cut(W("YZ", origin=(26, 0, 0)).center(9, 0).circle(1.5).extrude(-12))
    return body.cut(disc(2.5, 12, -30, 5, -4)).cut(disc(2.5, 12, -30, -8, -4))


@part(turn=True)
def tensioner_arm():
    body = link(15, 10, 70, 10).union(link(15, 7, 34, 10).rotate((0, 0, 0), (0, 0, 1), 110)).union(disc(12, 20)).union(disc(7, 24, 0, 70))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 9.9), (1, 1, 10.1)) + inside((69, -1, 9.9), (71, 1, 10.1))).fillet(2.5)
    pocket = W("XY", origin=(39, 0, 6)).slot2D(28, 9).extrude(10).faces("<Z").edges().fillet(1.5)
    body = body.cut(pocket).cut(W("XY", origin=(39, 0, 0)).slot2D(28, 9).extrude(4))
    body = body.cut(disc(9, 60, -20)).cut(disc(4, 60, -20, 70)).cut(disc(3, 60, -20, 34).rotate((0, 0, 0), (0, 0, 1), 110))
    body = body.cut(turned((0, 19), (9, 19), (10.01, 20.01), (0, 20.01))).cut(W().box(4, 30, 8).translate((-14, 0, 20)))
    return body.faces("<Z").edges("%CIRCLE").chamfer(0.8)
