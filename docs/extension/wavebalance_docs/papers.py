"""`.. paper-results:: folder` lists what `make reproduce` wrote for a paper: pictures, and how many statements of the
paper have which verdict. Without results it shows how to write them."""

import json
from collections import Counter
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive

from wavebalance_docs.commands import picture, table, with_formulas


def records(folder):
    """The records of the artefacts in a folder of results, in the order of their names."""
    found = [json.loads(file.read_text()) for file in sorted((folder / "records").glob("*.json"))]
    return [record for record in found if "identity" in record]


class PaperResults(Directive):
    required_arguments = 1

    def run(self):
        env = self.state.document.settings.env
        folder = Path(env.app.config.wavebalance_results) / self.arguments[0]
        found = records(folder) if folder.is_dir() else []
        if not found:
            text = ("No results were there when this site was made. Run make reproduce, then make docs again, and the "
                    "pictures and verdicts appear here.")
            return [nodes.admonition("", nodes.title("", "Not computed yet"), nodes.paragraph("", text))]
        return [self.verdicts(found), *(part for record in found for part in self.artefact(env, folder, record))]

    def verdicts(self, found):
        counts = Counter(statement["verdict"] for record in found for statement in record["statements"] if not statement["apart"])
        return table(["verdict", "statements"], [[name, number] for name, number in counts.most_common()])

    def artefact(self, env, folder, record):
        identity = record["identity"]
        images = [name for name in record["files"] if name.endswith(".svg")]
        title = f"{identity['number']}: {identity['title']}" if identity.get("number") else identity["title"]
        section = nodes.section(ids=[f"{self.arguments[0]}-{identity['stem']}".replace("_", "-")])
        section += nodes.title("", "", *with_formulas(title).children)
        for name in images[:1]:
            section += picture(env, folder / name, title, [])
        keys = ("place", "criterion", "measured", "verdict")
        rows = [[statement.get(key, "") for key in keys] for statement in record["statements"]]
        if rows:
            section += table(["place in the paper", "what decides", "computed", "verdict"], rows)
        return [section] if images or rows else []


def setup(app):
    app.add_config_value("wavebalance_results", "", "env")
    app.add_directive("paper-results", PaperResults)
