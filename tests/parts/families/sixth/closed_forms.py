"""Forms of one free face, closed."""
import cadquery as cq

from ..register import part
from ..shapes import W


@part(turn=True, offset=1.0)
def ellipsoid():
    return W(obj=W().sphere(10).val().transformGeometry(cq.Matrix([[2.6, 0, 0, 0], [0, 1.5, 0, 0], [0, 0, 1, 0]])))
