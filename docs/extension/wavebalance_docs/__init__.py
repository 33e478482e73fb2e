"""Sphinx extension of this site: examples that run, formulas by KaTeX, and references made from the sources."""

from wavebalance_docs import (capabilities, citations, commands, cpp_reference, formulas, notebook, papers, python_package, readme,
                              scene_keys)


def setup(app):
    for part in (capabilities, citations, commands, cpp_reference, formulas, notebook, papers, python_package, readme, scene_keys):
        part.setup(app)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
