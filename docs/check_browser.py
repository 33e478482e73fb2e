"""Opens every page of the site in chromium, at the width of a phone and of a tablet: nothing may be wider than the screen, every
formula must be set and every picture loaded. Usage: check_browser.py CHROMIUM FOLDER; exit code 1 where a page fails."""

import json
import re
import subprocess
import sys
import tempfile
from html import unescape
from pathlib import Path

WIDTHS = (400, 800)
PROBE = """<!doctype html><title>probe</title><pre id="faults"></pre><script>
const pages = PAGES;
const faults = [];
function look(frame, width, page) {
  const root = frame.contentDocument.documentElement;
  const count = selector => root.querySelectorAll(selector).length;
  if (root.scrollWidth > width) faults.push(`${page}: ${root.scrollWidth} pixels wide on a screen of ${width}`);
  if (count(".katex-error")) faults.push(`${page}: ${count(".katex-error")} formulas that KaTeX refuses`);
  if (count(".formula") != count(".formula .katex")) faults.push(`${page}: formulas that are not set`);
  for (const image of frame.contentDocument.images)
    if (image.complete && !image.naturalWidth) faults.push(`${page}: ${image.getAttribute("src")} does not load`);
}
function next() {
  if (!pages.length) { document.getElementById("faults").textContent = ["done", ...faults].join("\\n"); return; }
  const page = pages.shift(), widths = [...WIDTHS];
  const frame = document.createElement("iframe");
  // A page is loaded once: among widths below 1000 pixels, where site.js folds the contents, its styles alone differ.
  const lookAtEach = () => {
    if (!widths.length) { frame.remove(); next(); return; }
    const width = widths.shift();
    frame.style.width = `${width}px`;
    setTimeout(() => { look(frame, width, page); lookAtEach(); }, 100);
  };
  frame.style = `width: ${widths[0]}px; height: 700px; border: 0`;
  frame.onload = lookAtEach;
  frame.src = page;
  document.body.append(frame);
}
next();
</script>"""


def look_at(chromium, folder):
    """The faults that the probe finds, or nothing; raises where the browser does not finish."""
    pages = sorted(str(page.relative_to(folder)) for page in folder.rglob("*.html"))
    probe = folder / "browser_probe.html"
    probe.write_text(PROBE.replace("WIDTHS", json.dumps(WIDTHS)).replace("PAGES", json.dumps(pages)))
    try:
        with tempfile.TemporaryDirectory() as profile:
            done = subprocess.run([chromium, "--headless=new", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files",
                                   f"--user-data-dir={profile}", "--virtual-time-budget=120000", "--dump-dom",
                                   probe.as_uri()], capture_output=True, text=True, timeout=200)
    finally:
        probe.unlink()
    found = re.search(r'<pre id="faults">(.*?)</pre>', done.stdout, re.DOTALL)
    lines = unescape(found.group(1)).split("\n") if found else []
    if not lines or lines[0] != "done":
        raise SystemExit(f"chromium did not finish {len(pages)} pages:\n{done.stderr[-2000:]}")
    return len(pages), lines[1:]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: check_browser.py CHROMIUM FOLDER")
    number, found = look_at(sys.argv[1], Path(sys.argv[2]).resolve())
    print("\n".join(found) if found else f"{number} pages at {len(WIDTHS)} widths: all fit")
    sys.exit(1 if found else 0)
