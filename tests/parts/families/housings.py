"""Blocks, brackets and housings: planes with holes, fillets and drafts."""
import math

import cadquery as cq
import numpy as np
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet

from .register import part
from .shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0, scale=3)
def pillow_block():
    body = W().box(120, 40, 14, centered=(True, True, False)).edges("|Z").fillet(10)
    boss = W("XZ").center(0, 34).circle(28).extrude(18, both=True)
    web = W().box(56, 36, 34, centered=(True, True, False))
    body = body.union(web).union(boss).cut(W("XZ").center(0, 34).circle(17).extrude(50, both=True))
    body = body.cut(W("XZ", origin=(0, -18, 34)).circle(21).extrude(-4))
    body = body.faces("<Z").workplane(invert=True).pushPoints([(-46, 0), (46, 0)]).circle(4.5).extrude(14, combine="cut")
    return less(body, [disc(8, 6, 9, x) for x in (-46, 46)])


@part(turn=True)
def manifold_block():
    body = W().box(80, 50, 40).edges().chamfer(1.5)
    drill = lambda r, depth: turned((0, 0.01), (r + 2.5, 0.01), (r + 2.5, -1.2), (r + 1, -6), (r, -6.6), (r, -depth),
                                    (0, -depth - r * 0.6)).rotate((0, 0, 0), (0, 0, 1), 30)
    down = drill(5, 30)
    body = less(body, [down.translate((x, 0, 20)) for x in (-25, 0, 25)])
    body = body.cut(drill(4, 64).rotate((0, 0, 0), (0, 1, 0), 90).translate((40, 0, 0)))
    body = body.cut(drill(3, 28).rotate((0, 0, 0), (1, 0, 0), 90).translate((-12.5, -25, 2)))
    body = body.cut(drill(3.5, 25).rotate((0, 0, 0), (1, 0, 0), 90).translate((25, -25, -6)))
    return less(body, [disc(2.6, 60, -30, x, y) for x in (-34, 34) for y in (-19, 19)])


@part(turn=True)
def clevis():
    body = W().box(50, 30, 30).translate((5, 0, 0)).edges("|X").fillet(4)
    eye = W("XZ", origin=(30, 0, 0)).circle(15).extrude(15, both=True).union(W().box(30, 30, 30).translate((15, 0, 0)))
    body = W().box(20, 30, 30).translate((-10, 0, 0)).edges("|X").fillet(4).union(eye)
    body = body.cut(W().box(60, 12, 40).translate((30, 0, 0)).edges("|Z").fillet(5.9))
    body = body.cut(W("XZ", origin=(30, 0, 0)).circle(6).extrude(40, both=True))
    shank = W("YZ", origin=(-20, 0, 0)).circle(9).extrude(-30)
    body = body.union(shank).edges(cq.selectors.BoxSelector((-20.5, -10, -10), (-19.5, 10, 10))).edges("%CIRCLE").fillet(2.5)
    return body.faces("<X").edges().chamfer(1)


@part(turn=True, offset=1.0)
def variable_bracket():
    body = W("XZ").polyline([(0, 0), (60, 0), (60, 8), (9, 8), (9, 50), (0, 50)]).close().extrude(20, both=True)
    tool = BRepFilletAPI_MakeFillet(body.val().wrapped)
    tool.Add(3.0, 9.0, body.edges("|Y").edges(cq.selectors.NearestToPointSelector((9, 0, 8))).val().wrapped)
    tool.Add(6.0, 2.0, body.edges("|Y").edges(cq.selectors.NearestToPointSelector((0, 0, 0))).val().wrapped)
    tool.Add(1.0, 1.0, body.edges("|X").edges(cq.selectors.NearestToPointSelector((30, 20, 0))).val().wrapped)
    body = W(obj=cq.Shape.cast(tool.Shape()).Solids()[0])
    return less(body, [disc(3.5, 30, -5, 40, y) for y in (-11, 11)] + [W("YZ", origin=(-5, 0, 35)).circle(5).extrude(30)])


@part()
def sheet_channel():
    path = W("XZ").moveTo(-32, 40).lineTo(-32, 6).threePointArc((-32 + 6 - 6 / math.sqrt(2), 6 - 6 / math.sqrt(2)), (-26, 0)).lineTo(26, 0)
    path = path.threePointArc((26 + 6 / math.sqrt(2), 6 - 6 / math.sqrt(2)), (32, 6)).lineTo(32, 24)
    path = path.threePointArc((32 + 6 - 6 / math.sqrt(2), 24 + 6 / math.sqrt(2)), (38, 30)).lineTo(52, 30)
    body = W("XZ").add(path.wire()).toPending().offset2D(1.0, "arc").extrude(30, both=True)
    body = body.cut(W().center(0, 0).slot2D(24, 8).extrude(10, both=True))
    body = body.cut(W("YZ", origin=(-40, 0, 24)).rarray(20, 1, 2, 1).circle(4).extrude(20))
    return body.cut(W("XY", origin=(46, 0, 20)).rarray(1, 36, 1, 2).circle(2.2).extrude(20))


@part(turn=True)
def t_bracket():
    rib = W().box(70, 8, 26).translate((0, 0, 14)).edges("|Z").fillet(3)
    body = W().box(90, 50, 10).union(W().box(10, 50, 45).translate((0, 0, 27))).union(rib)
    body = body.edges(cq.selectors.BoxSelector((-36, -24, 4.9), (36, 24, 5.1))).fillet(3)
    return less(body, [disc(4, 30, -10, x, y) for x in (-35, 35) for y in (-15, 15)]).edges("|Z").edges("<X or >X").fillet(3)


@part()
def drafted_box():
    body = W().sketch().rect(100, 70).vertices().fillet(10).finalize().extrude(35, taper=3)
    inner = W().sketch().rect(95, 65).vertices().fillet(7.5).finalize().extrude(32, taper=3)
    body = body.edges(">Z").fillet(3).cut(inner)
    ribs = [W().box(90, 2, 14).translate((0, y, 26)) for y in (-15, 15)] + [W().box(2, 60, 10).translate((0, 0, 28))]
    body = joined(body, [rib.intersect(inner.union(W().box(80, 50, 4).translate((0, 0, 32)))) for rib in ribs])
    bosses = [W("XY", origin=(x, y, 33)).circle(5).extrude(-30, taper=1) for x in (-36, 36) for y in (-22, 22)]
    body = joined(body, bosses)
    body = less(body, [W("XY", origin=(x, y, 2)).circle(1.6).extrude(22) for x in (-36, 36) for y in (-22, 22)])
    return body.cut(W("XZ", origin=(0, 0, 16)).slot2D(20, 8).extrude(60))


@part(turn=True, offset=1.0)
def finned_sink():
    body = W().box(60, 60, 5, centered=(True, True, False))
    fin = W("XZ", origin=(0, 30, 0)).moveTo(-1.4, 4).lineTo(-0.8, 24).threePointArc((0, 24.8), (0.8, 24)).lineTo(1.4, 4).close().extrude(60)
    body = joined(body, [fin.translate((x, 0, 0)) for x in np.linspace(-27, 27, 10)])
    body = body.cut(W().box(70, 8, 40).translate((0, 0, 25)))
    return less(body, [disc(1.7, 10, -1, x, 0) for x in (-24, 24)]).cut(W().box(30, 30, 1))


@part(uniform=False, turn=True, offset=3.0)
def perforated_plate():
    body = W().box(160, 100, 4).edges("|Z").chamfer(8).faces(">Z").edges().chamfer(0.5)
    body = body.cut(W().rarray(7, 7, 17, 9).circle(1.4).extrude(10, both=True))
    sink = turned((0, -3), (2.6, -3), (2.6, 0), (4.9, 2.01), (0, 2.01))
    return less(body, [sink.translate((x, y, 0)) for x in (-69, 69) for y in (-36, 36)])


@part(turn=True, offset=1.0, scale=0.03)
def hinge_leaf():
    body = W().box(60, 34, 3).translate((0, 21, -4.5)).edges("|Z and >Y").fillet(6)
    knuckle = W("YZ", origin=(-30, 0, 0)).circle(6).extrude(60).union(W().box(60, 12, 3).translate((0, 6, -4.5)))
    body = body.union(knuckle).cut(W("YZ", origin=(-40, 0, 0)).circle(2.5).extrude(80))
    body = less(body, [W().box(12.4, 13.2, 20).translate((x, 0, 0)) for x in (-12, 12)])
    sink = turned((0, -9), (2.2, -9), (2.2, -4.7), (4, -2.99), (0, -2.99))
    return less(body, [sink.translate((x, y, 0)) for x, y in ((-20, 18), (20, 18), (0, 29))])


@part(turn=True, offset=1.0, scale=3)
def pipe_tee():
    body = W("YZ").circle(16).extrude(45, both=True).union(disc(11, 40))
    body = body.edges(cq.selectors.BoxSelector((-15, -15, 5), (15, 15, 20))).edges("not %LINE").fillet(4)
    body = body.union(W("YZ", origin=(45, 0, 0)).circle(22).extrude(5)).union(W("YZ", origin=(-50, 0, 0)).circle(22).extrude(5)).union(disc(17, 5, 38))
    return body.cut(W("YZ").circle(13).extrude(80, both=True)).cut(disc(8, 60))


@part(uniform=False)
def stud_brick():
    body = W().box(31.8, 15.8, 9.6, centered=(True, True, False)).cut(W().box(29.4, 13.4, 8.4, centered=(True, True, False)))
    studs = [disc(2.4, 1.7, 9.6, x, y).faces(">Z").edges().fillet(0.2) for x in (-12, -4, 4, 12) for y in (-4, 4)]
    tubes = [disc(3.25, 9, 0, x).cut(disc(2.4, 8.4, 0, x)) for x in (-8, 0, 8)]
    return less(joined(body, studs + tubes), [disc(1.3, 1, 8, x, y) for x in (-12, -4, 4, 12) for y in (-4, 4)])


@part()
def node_lattice():
    span = 20.0
    nodes = [(x, y, z) for x in (0, span) for y in (0, span) for z in (0, span)]
    body = joined(W().sphere(4).translate(nodes[0]), [W().sphere(4).translate(q) for q in nodes[1:]])
    for x, y, z in nodes:
        for plane, axis in (("YZ", 0), ("XZ", 1), ("XY", 2)):
            if (x, y, z)[axis] == 0:
                body = body.union(W(plane, origin=(x, y, z)).circle(1.8).extrude(span * (-1 if axis == 1 else 1)))
    return body.edges("%CIRCLE").fillet(0.7)
