"""Particle files of other programs, made into one `.hdf` that pairsum and ParaView read: `pairsum convert`.

    from pairsum_results.particles import Asked, convert
    print(convert(Asked("out.hdf", fluid=["water.vtp"], boundary=["wall.vtp"])))
"""
from .converted import Asked, convert  # noqa: F401
