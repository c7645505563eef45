"""Build hook: includes the built viewer in every wheel and source distribution, so that installing needs no Node."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageBuildHook(BuildHookInterface):
    """Builds the viewer with npm if npm is available; otherwise, the viewer must have been built.

    ``SKIP_WEB_BUILD`` keeps an existing build. An editable install needs none: the server reports that it is missing.
    """

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Put the viewer in its place before the files are collected.

        Raises:
            RuntimeError: the viewer is not built, and npm is not available.
        """
        if version == "editable":
            return
        static = Path(self.root, "reactive_realizer", "server", "static")
        if "SKIP_WEB_BUILD" not in os.environ and shutil.which("npm"):
            self._build_page(static)
        if not (static / "index.html").exists():
            raise RuntimeError("the page is not built: run `make page`, or install Node 20 or newer")

    def _build_page(self, static: Path) -> None:
        web = Path(self.root, "web")
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=web, check=True)
        subprocess.run(["npm", "run", "build", "--", "--outDir", str(static), "--emptyOutDir"], cwd=web, check=True)
        avatars = Path(self.root, "reactive_realizer", "assets", "avatars")
        subprocess.run([sys.executable, web / "compress.py", static, avatars], check=True)
