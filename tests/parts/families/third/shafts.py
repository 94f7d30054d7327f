"""Shafts, spindles, centres and studs: turned, some of them milled or ground out of centre."""
import cadquery as cq

from ..register import part
from ..second.outlines import inside, link
from ..shapes import W, disc, turned, less


@part(turn=True, offset=1.0)
def cam_shaft():
    body = turned((0, -70), (9, -70), (10, -69), (10, 69), (9, 70), (0, 70))
    lobe = link(15, 5, 13, 10)
    for z, a in ((-56, 0), (-36, 180), (-6, 270), (14, 90)):
        body = body.union(lobe.rotate((0, 0, 0), (0, 0, 1), a).translate((0, 0, z)))
    for z in (-19, 31):
        body = body.union(turned((0, z - 1), (11, z - 1), (16, z), (16, z + 8), (11, z + 9), (0, z + 9)))
    body = body.union(disc(13, 12, 52)).cut(W().box(5, 5, 14).translate((0, 12.5, 60)))
    body = body.cut(disc(3, 160, -80)).cut(turned((0, -71), (5, -71), (3, -68), (0, -68)))
    return less(body, [W("YZ", origin=(0, 0, z)).circle(1.5).extrude(30) for z in (-15, 35)])


@part(turn=True, offset=1.0, scale=2)
def live_center():
    body = turned((0, -80), (8, -80), (9, -79), (12, -19), (12, -14), (20, -14), (21, -13), (21, 12), (18, 16), (0, 16))
    body = body.union(turned((0, 16), (11, 16), (11, 18), (14, 18), (14, 22), (8.66, 27), (0, 42)))
    body = body.cut(turned((19.4, -2), (22, -2), (22, 4), (19.4, 4))).cut(turned((0, -81), (4, -81), (4, -60), (0, -57)))
    flats = [W().box(60, 8, 6).translate((0, 20 * s, 9)) for s in (-1, 1)]
    body = body.edges("%CIRCLE").edges(inside((-1, -1, -14.1), (1, 1, -13.9))).edges(cq.selectors.RadiusNthSelector(0)).fillet(2)
    return less(body, flats).cut(W("YZ", origin=(0, 0, -8)).circle(2).extrude(30))


@part(turn=True)
def valve_spool():
    r, z, profile = 8, 0, [(0, 0)]
    for length, land in ((10, True), (7, False), (14, True), (9, False), (14, True), (7, False), (10, True)):
        profile += [(r if land else 4.5, z), (r if land else 4.5, z + length)]
        z += length
    body = turned(*profile, (0, z))
    for k in (10, 17, 31, 40, 54, 61):
        body = body.edges("%CIRCLE").edges(inside((-1, -1, k - 0.1), (1, 1, k + 0.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(1.2)
    lands = (2.5, 5, 7.5, 20, 24, 28, 43, 47, 51, 63.5, 66, 68.5)
    body = less(body, [turned((7.5, c - 0.4), (9, c - 0.4), (9, c + 0.4), (7.5, c + 0.4)) for c in lands])
    notch = lambda z0: W("XZ", origin=(0, 0, z0)).circle(1.5).extrude(20, both=True).cut(disc(6.4, 200, -50))
    body = less(body, [notch(q) for q in (17, 31, 40, 54)])
    return body.faces("<Z or >Z").edges().chamfer(0.5).cut(turned((0, -1), (2, -1), (2, 8), (0, 9.2))).cut(turned((0, z + 1), (2, z + 1), (2, z - 8), (0, z - 9.2)))


@part(turn=True, offset=1.0)
def bar_bell():
    body = disc(5, 60, -30).union(W().sphere(15).translate((0, 0, 34))).union(W().sphere(15).translate((0, 0, -34)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, -21), (1, 1, 21))).fillet(5)
    body = body.union(turned((0, -4), (6.5, -4), (7.5, -3), (7.5, 3), (6.5, 4), (0, 4)))
    return body.cut(W().box(60, 60, 10).translate((0, 0, 52))).cut(W().box(60, 60, 10).translate((0, 0, -52))).cut(disc(2.2, 20, 40))


@part(turn=True)
def toggle_pin():
    body = disc(6, 44).union(turned((0, 44), (9, 44), (9, 50), (7, 52), (0, 52)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 43.9), (1, 1, 44.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(1)
    body = body.edges("<Z").edges("%CIRCLE").fillet(2)
    body = body.cut(W().box(30, 3.2, 18).translate((0, 0, 11)).edges("|Y").fillet(3))
    body = body.cut(W("XZ", origin=(0, 0, 7)).circle(1.4).extrude(20, both=True))
    ring = W(obj=cq.Solid.makeTorus(8, 1.6)).rotate((0, 0, 0), (1, 0, 0), 90).translate((0, 0, 57))
    body = body.union(ring)
    return body.cut(turned((5.4, 34), (7, 34), (7, 36), (5.4, 36))).cut(W("YZ", origin=(0, 0, 28)).circle(1.6).extrude(20, both=True))
