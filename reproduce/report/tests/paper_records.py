"""Records as the steps of a paper leave them, and the pages that the program of the report makes of them."""

import json
import subprocess

from paper_results import built_program

IMAGE = '<svg xmlns="http://www.w3.org/2000/svg" width="800" height="600"></svg>'


def record(stem, number="JL14 Fig.", title="", **parts):
    """The record of a step in addition to its files; pages_of() sets the paper."""
    return {"identity": {"paper": "", "number": number, "title": title, "stem": stem}, "caption": "", "files": [],
            "data": [], "scenes": [], "notes": [], "statements": [], "checks": [], "unjudged": [], "slips": [],
            "table": [], "program": "", "wall_seconds": 0.0, "version": "", **parts}


def statement(place, quote, criterion, measured, verdict, **parts):
    return {"place": place, "quote": quote, "criterion": criterion, "measured": measured, "verdict": verdict,
            "because": "", "readings": [], "panel": "", "apart": "", "claim": "", "headline": "", **parts}


def check(sentence, passes):
    measured = "0.5" if passes else "2"
    return {"place": "", "sentence": sentence, "criterion": "y < 1", "measured": measured, "passes": passes}


def pages_of(folder, records, paper, beside):
    """Writes the records of a paper with their files, and makes their pages; returns the folder."""
    for name, text in beside.items():
        (folder / paper / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / paper / name).write_text(text)
    (folder / paper / "records").mkdir(parents=True, exist_ok=True)
    for one in records:
        one["identity"]["paper"] = paper
        (folder / paper / "records" / f"{one['identity']['stem']}.json").write_text(json.dumps(one))
    program = built_program("WAVEBALANCE_REPORT_PAGE", "report", "wavebalance_report_page")
    subprocess.run([program, "--results", folder, "--commit", "abc123", "--compiler", "GNU 12"], check=True)
    return folder
