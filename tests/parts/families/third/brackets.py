"""Brackets, hangers, mounts and levers."""
import math

from ..register import part
from ..second.outlines import inside, link, nearest
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def angle_motor_mount():
    body = W().box(58, 52, 5, centered=(True, False, False)).union(W().box(58, 5, 56, centered=(True, False, False)))
    side = W("YZ").polyline([(2, 2), (48, 2), (48, 7), (7, 52), (2, 52)]).close().extrude(5)
    body = body.union(side.translate((24, 0, 0))).union(side.translate((-29, 0, 0)))
    body = body.edges("|X").edges(nearest((0, 5, 5))).fillet(3).edges("|Z").edges("<Y").fillet(4)
    body = body.cut(W("XZ", origin=(0, 0, 31)).circle(11.5).extrude(20, both=True))
    body = less(body, [W("XZ", origin=(x, 0, 31 + z)).circle(1.6).extrude(20, both=True) for x in (-15.5, 15.5) for z in (-15.5, 15.5)])
    return less(body, [W("XY", origin=(x, 30, -1)).slot2D(18, 5.5, 90).extrude(20) for x in (-14, 14)])


@part(turn=True, offset=1.0)
def three_way_corner():
    body = W().sphere(15)
    arms = [W("XY").rect(20, 20).extrude(46).edges("|Z").chamfer(3)]
    arms += [arms[0].rotate((0, 0, 0), (0, 1, 0), 90), arms[0].rotate((0, 0, 0), (1, 0, 0), 90)]
    body = joined(body, arms)
    bore = turned((0, 16), (6.5, 20), (6.5, 45), (7.6, 46.01), (0, 46.01))
    body = less(body, [bore, bore.rotate((0, 0, 0), (0, 1, 0), 90), bore.rotate((0, 0, 0), (1, 0, 0), 90)])
    body = less(body, [W("XZ", origin=(36, 0, 0)).circle(1.6).extrude(-20), W("XZ", origin=(0, 0, 36)).circle(1.6).extrude(-20)])
    return body.cut(W("XY", origin=(0, -36, 0)).circle(1.6).extrude(20))


@part(turn=True)
def damper_mount():
    body = W().box(70, 36, 6, centered=(True, True, False)).edges("|Z").fillet(11)
    cup = turned((0, 0), (17, 0), (14, 22), (0, 22))
    body = body.union(cup).edges("%CIRCLE").edges(inside((-1, -1, 5.9), (1, 1, 6.1))).fillet(4)
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 21.9), (1, 1, 22.1))).fillet(3)
    body = body.cut(turned((0, -1), (12, -1), (9.5, 17), (0, 17)))
    body = body.union(turned((0, 14), (6, 14), (6, 30), (5, 31), (0, 31))).cut(turned((0, 10), (3.3, 10), (3.3, 40), (0, 40)))
    return less(body, [W("XY", origin=(x, 0, -1)).slot2D(11, 6.5).extrude(20) for x in (-25, 25)])


@part(turn=True, offset=0.5)
def rocker_arm():
    body = link(14, 8, 44, 12, -6).union(link(14, 10, 38, 12, -6).rotate((0, 0, 0), (0, 0, 1), 164))
    body = body.union(disc(13, 24, -12))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, -6.1), (1, 1, -5.9)) + inside((-1, -1, 5.9), (1, 1, 6.1))).fillet(0.8)
    body = body.cut(disc(8.5, 60, -30)).cut(disc(4, 60, -30, 44))
    fork = W().box(30, 40, 6).translate((-42, 0, 0)).edges("|Y").edges(">X").fillet(2.9)
    body = body.cut(fork).cut(disc(3.5, 60, -30, 38 * math.cos(math.radians(164)), 38 * math.sin(math.radians(164))))
    body = body.faces("<Z or >Z").edges("%CIRCLE").chamfer(0.7)
    return body.cut(W("XZ", origin=(0, 0, 0)).circle(1.5).extrude(30))


@part(turn=True, offset=1.0)
def t_slot_gusset():
    body = W().box(38, 38, 38, centered=False).edges("|Y").edges(">X and >Z").chamfer(30)
    body = body.cut(W().box(60, 28, 60, centered=False).translate((5, 5, 5)).edges("|Y").edges("<X and <Z").fillet(5))
    tongue = W().box(4, 8, 2)
    body = body.union(tongue.translate((32, 19, -0.8)).edges("|Z").fillet(1.5)).union(W().box(2, 8, 4).translate((-0.8, 19, 32)).edges("|X").fillet(1.5))
    body = body.cut(W("XY", origin=(18, 19, -3)).slot2D(12, 6.6).extrude(20)).cut(W("YZ", origin=(-3, 19, 18)).slot2D(12, 6.6, 90).extrude(20))
    return less(body, [W("XZ", origin=(x, 0, z)).circle(r).extrude(-60) for x, z, r in ((12, 12, 3), (22, 9, 1.6), (9, 22, 1.6))])
