"""The third series: parts made after the second was looked at, and run through no segmenter while they were made."""
from . import brackets, closed_forms, components, ducts, fittings, foils, grips, imported, plates, printed, shafts, skins, vessels, wheels

__all__ = ["brackets", "closed_forms", "components", "ducts", "fittings", "foils", "grips", "imported", "plates", "printed",
           "shafts", "skins", "vessels", "wheels"]
