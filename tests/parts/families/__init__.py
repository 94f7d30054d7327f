"""The parts, by family."""
from . import electrical, free_forms, gears, housings, turned_parts
from .register import PARTS

__all__ = ["PARTS", "electrical", "free_forms", "gears", "housings", "turned_parts"]
