"""Maps in notebooks and browsers."""

from __future__ import annotations

import base64
import html
import os
import tempfile
import webbrowser
from typing import TYPE_CHECKING

from ._errors import ImageError

if TYPE_CHECKING:
    from ._sphere_map import SphereMap

most_bytes = 200_000
"""Of what a notebook keeps of a map."""


def _picture(mapped: SphereMap) -> str:
    """Mesh and sphere side by side, as large as there is room for; empty without an image module."""
    for size in (300, 220, 150, 90):
        try:
            png = mapped.picture(size=size)
        except ImageError:
            return ""
        data = base64.b64encode(png).decode()
        if len(data) < most_bytes - 8000:
            return f'<img alt="the mesh and its sphere" src="data:image/png;base64,{data}">'
    return ""


def _maker(method: str, stage: str) -> str:
    """The method and its last stage, each once."""
    return stage if stage.startswith(method) else ", ".join(filter(None, (method, stage)))


def html_of(mapped: SphereMap) -> str:
    """The mesh and its sphere, verdict and figures."""
    distortion, provenance = mapped.distortion, mapped.provenance
    rows = [
        ("map", mapped.certificate.verdict),
        ("vertices, faces", f"{len(mapped.vertices):,}, {len(mapped.faces):,}"),
        ("area, mean |ln ratio|", f"{distortion.mean_abs_ln_area:.3f}"),
        ("angle, mean |ln ratio|", f"{distortion.mean_abs_ln_angle:.3f}"),
        ("conformal, mean σ₁/σ₂", f"{distortion.quasi_conformal_mean:.3f}"),
        ("made by", _maker(provenance.get("method", ""), provenance.get("stage", ""))),
        ("values", ", ".join(list(mapped.values)[:12])),
    ]
    cells = "".join(
        f"<tr><td>{html.escape(name)}</td><td>{html.escape(text)}</td></tr>" for name, text in rows if text
    )
    title = html.escape(mapped.name[:80])
    return f'<div class="sphparam"><b>{title}</b><div>{_picture(mapped)}</div><table>{cells}</table></div>'


def show(mapped: SphereMap, size: int) -> str:
    """Writes the page to a folder of its own and opens it."""
    path = os.path.join(tempfile.mkdtemp(prefix="sphparam-"), "map.html")
    mapped.report(path, size=size)
    webbrowser.open("file://" + path)
    return path
