"""A level to look around in: one page of HTML, which a notebook shows and a browser opens."""
from __future__ import annotations

import base64
import html
import json
import os
import pathlib
import re
import tempfile
from typing import Any, Union

from ._library import as_count, as_point
from .errors import BadArgument

HERE = pathlib.Path(__file__).resolve().parent
_PAGE = """<!doctype html>
<meta charset="utf-8">
<title>Sightline</title>
<style>body { margin: 0; font: 13px sans-serif } canvas { display: block; max-width: 100%; touch-action: none }</style>
<canvas width="WIDTH" height="HEIGHT" aria-label="NAME"></canvas>
<output></output>
<script type="application/json" id="level">LEVEL</script>
<script type="importmap">{"imports": {"sightline": "PACKAGE"}}</script>
<script type="module">
PROGRAM</script>
"""


def _address(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


def _bundled(package: pathlib.Path, name: str) -> str:
    """A module of the npm package as an address that holds it and all that it loads: of WebAssembly, level.wasm alone."""
    text = (package / name).read_text(encoding="utf-8")
    text = re.sub(r"from '\./([\w-]+\.js)'", lambda found: f"from '{_bundled(package, found[1])}'", text)
    text = re.sub(r"new URL\('\./(level\.wasm)', import\.meta\.url\)", lambda found:
                  f"new URL('{_address('application/wasm', (package / found[1]).read_bytes())}')", text)
    return _address("text/javascript", text.encode("utf-8"))


class Explorer:
    """See Level.explorer."""

    def __init__(self, level: Any, eye: Any, width: int,
                 package: Union[str, "os.PathLike[str]", None]) -> None:
        x0, y0, x1, y1 = level.bounds
        self.width = max(64, as_count(width, "width", 8192))
        self.height = min(8192, max(64, round(self.width * (y1 - y0) / (x1 - x0))))
        if eye is None:
            eye = level.starts[0, :2] if len(level.starts) else ((x0 + x1) / 2, (y0 + y1) / 2)
        place = as_point(eye, "eye").tolist()
        folder = pathlib.Path(package or os.environ.get("SIGHTLINE_NPM") or HERE / "npm")
        if not (folder / "level.wasm").is_file():
            raise BadArgument(f"package: {folder} is not the folder of the npm package 'sightline'")
        with tempfile.TemporaryDirectory() as scratch:
            file = pathlib.Path(scratch, "level.slv")
            level.save(file)
            slv = base64.b64encode(file.read_bytes()).decode("ascii")
        parts = {"WIDTH": str(self.width), "HEIGHT": str(self.height), "NAME": html.escape(repr(level), quote=True),
                 "LEVEL": json.dumps({"slv": slv, "eye": place}),
                 "PACKAGE": _bundled(folder, "sightline.js"),
                 "PROGRAM": (HERE / "explorer.js").read_text(encoding="utf-8")}
        #: The page, which needs neither a kernel nor a network.
        self.page: str = re.sub("|".join(parts), lambda found: parts[found[0]], _PAGE)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Write the page to a file."""
        pathlib.Path(path).write_text(self.page, encoding="utf-8")

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.page, quote=True)}" width="{self.width}" '
                f'height="{self.height + 24}" style="border: 0; max-width: 100%"></iframe>')
