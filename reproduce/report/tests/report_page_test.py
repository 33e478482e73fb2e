"""The pages over the results of the papers, which the program of the report makes from records."""

import html
import os
import re

import pytest
from paper_records import IMAGE, check, pages_of, record, statement
from paper_results import Table

STEM = "fig01_example"


def judged(**changes):
    """A record of three statements, of which one agrees, one differs and one depends on what is open."""
    readings = [{"name": "x = 2", "verdict": "differs", "measured": "2", "of_text": True},
                {"name": "x = 1", "verdict": "agrees", "measured": "1", "of_text": True}]
    statements = [statement("section 1", "holds", "x < 1", "0.5", "agrees"),
                  statement("section 2", "depends", "x < 1", "1.5", "depends", because="x is open. More.",
                            readings=readings, panel="(b)"),
                  statement("section 3", "fails", "x < 1", "3", "differs", because="x is large")]
    scenes = [{"name": "one.toml", "overrides": [["time.functions=8", "time.trial=haar"], ["time.functions=16"]]}]
    return record(STEM, number="JL14 Fig. 1", title='A < B & "C"', caption="caption with $x < 1$",
                  files=[f"{STEM}.csv", f"{STEM}.svg", f"{STEM}.png"], scenes=scenes, statements=statements,
                  data=[{"name": f"{STEM}.csv", "units": "in SI units", "notes": ["a remark on the data"]}],
                  notes=["a note"], checks=[check("checked", True)], table=[["a", "b"], ["1 | <2>", "3"]],
                  program="jl14 fig01", wall_seconds=0.25, version="0.1.0", **changes)


def another_reading(one):
    """Adds to the statement that depends a reading that the text does not allow."""
    one["statements"][1]["readings"].append({"name": "x = 7", "verdict": "agrees", "measured": "7", "of_text": False})


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Makes the pages of records; returns their folder."""
    files = {f"{STEM}.svg": IMAGE, f"{STEM}.figure.js": "// curves\n", "scenes/one.toml": "[contact]\n"}

    def make(*records, paper="jones_legrand_2014", beside=files):
        return pages_of(tmp_path_factory.mktemp("results"), records, paper, beside)

    return make


@pytest.fixture(scope="module")
def page(pages):
    """The page of the unchanged record, and of one that a function has changed."""
    made = {}

    def text(change=None):
        if change not in made:
            one = judged()
            if change:
                change(one)
            made[change] = (pages(one) / "index.html").read_text()
        return made[change]

    return text


def section(text, name):
    """The text of the first section with the id."""
    begin = text.index(f'<section id="{name}"')
    return text[begin:text.index("</section>", begin)]


def attributes(text, name):
    """The values of all attributes of that name."""
    return re.findall(f' {name}="([^"]*)"', text)


def copied(text):
    """Commands as they are copied from a page, whose options are separate elements."""
    return re.sub('<span class="whole">([^<]*)</span>', r"\1", text)


def test_a_page_escapes_what_it_shows(page):
    assert "A &lt; B &amp; &quot;C&quot;" in page()
    assert "A < B" not in page()
    assert '<span class="math">x &lt; 1</span>' in page()


def test_a_page_opens_with_counts_and_six_findings_that_hold_and_three_that_do_not(page):
    assert "Of 3 statements 1 agrees, 1 differs, 1 depends on what the paper leaves open." in section(page(), "brief")

    def many(one):
        one["statements"][0].update(claim="x is small", headline="It is 0.5.")
        one["statements"][2]["headline"] = "It is 3."
        one["statements"] += [one["statements"][0], one["statements"][2]] * 10

    findings = section(page(many), "brief").split("</ul>")[0]
    assert findings.count("<li>") == 9
    assert findings.count("<b>x is small:</b> It is 0.5.") == 6
    assert findings.count("It is 3.") == 3
    assert findings.rindex("It is 0.5.") < findings.index("It is 3.")


def test_statements_judged_apart_are_shown_and_not_counted(page):

    def apart(one):
        one["statements"][0].update(apart="on another body", headline="It is 0.5.")

    text = page(apart)
    assert "Of 2 statements 1 differs, 1 depends" in section(text, "brief")
    assert "It is 0.5." not in section(text, "brief")
    assert 'class="cell agrees apart"' in section(text, "matrix")
    assert "dashed: on another body, not counted" in section(text, "matrix")
    assert "agrees · on another body, not counted" in text


def test_readings_that_the_text_does_not_allow_stand_beside_the_others(page):
    text = page(another_reading)
    assert "depends: 1 of 2 interpretations<" in text
    assert "<th>If instead (1 of 1 agree)</th>" in text
    assert 'statement 2: depends">1/2</a>' in section(text, "matrix")


def test_a_page_lists_what_is_not_judged_and_all_misprints_in_one_place(page):
    assert "misprint of the papers" not in section(page(), "rule")

    def open_ends(one):
        one["unjudged"] = [{"place": "section 4", "quote": "somehow", "reason": "It names nothing.", "found": "2 N"}]
        one["slips"] = [{"place": "eq. (20)", "printed": "1/T", "meant": "1/m", "shown": "eq. (23)"}]
        one["statements"][2]["verdict"] = "misprint"

    rule = section(page(open_ends), "rule")
    name = "Jones &amp; Legrand 2014"
    assert "One sentence that cannot be judged" in rule
    assert f"<td>{name}, section 4</td><td>somehow</td><td>It names nothing.</td><td>2 N</td>" in rule
    assert "All 2 misprints of the papers" in rule
    assert f"<td>{name}, eq. (20)</td><td>1/T</td><td>1/m</td><td>eq. (23)</td>" in rule
    assert f"<td>{name}, section 3</td><td>fails</td>" in rule


@pytest.mark.parametrize("paper, rows", [("jones_legrand_2014", 3), ("extremes", 0)])
def test_the_table_of_verdicts_has_a_row_for_each_statement_of_a_paper(pages, paper, rows):
    one = judged()
    another_reading(one)
    table = Table.read(pages(one, paper=paper) / "verdicts.csv")
    assert len(table) == rows
    if rows:
        assert (table.rows[1]["id"], table.rows[1]["verdict"]) == (f"{STEM}-2", "depends")
        assert list(table.numbers("readings_of_text")) == [0, 2, 0]
        assert list(table.numbers("agreeing_of_text")) == [0, 1, 0]
        assert list(table.numbers("readings_if_instead")) == [0, 1, 0]


def test_the_matrix_has_one_linked_cell_for_each_statement(page):
    matrix = section(page(), "matrix")
    for number in (1, 2, 3):
        assert attributes(matrix, "href").count(f"#{STEM}-{number}") == 1
    assert 'aria-label="JL14 Fig. 1, statement 2: depends">1/2</a>' in matrix


def test_every_anchor_exists_once(page):
    ids = attributes(page(), "id")
    assert len(ids) == len(set(ids))
    targets = {target[1:] for target in attributes(page(), "href") if target.startswith("#")}
    assert targets and targets <= set(ids)


@pytest.mark.parametrize("part", ["panel (b), section 2", "<summary>How it is decided</summary>\n<p>x &lt; 1</p>",
                                  "<dt>Found</dt><dd>0.5</dd>", "<p>Found: 1.5</p>", "<dt>Because</dt><dd>x is open. More.</dd>",
                                  "depends: 1 of 2 interpretations", "<th>Allowed by the text</th>", "<td>x = 2</td>"])
def test_a_card_says_what_decides_what_is_found_and_why(page, part):
    assert part in page()


def test_a_page_states_the_rule(page):
    assert "Values within 10 % of each other tie." in section(page(), "rule")


def test_a_page_opens_with_what_is_compared(page):
    assert page().index("Sentences and not curves are compared") < page().index('id="brief"')


def test_interpretations_and_notes_are_folded(page):
    assert page().count('<details class="readings">') == 3
    assert '<details class="more"><summary>Notes</summary>\n<ul class="notes">\n<li>a note</li>' in page()


def test_heads_of_tables_may_break_between_words(page):

    def long_head(one):
        one["table"][0][0] = "smallest_coefficient_error"

    assert "<th>smallest coefficient error</th>" in page(long_head)


def test_checks_are_folded_and_not_counted(page):
    assert "One check of the code, not counted: it passes" in page()

    def failing(one):
        one["checks"].append(check("checked too", False))

    text = page(failing)
    assert '<details class="checks" open><summary>2 checks of the code, not counted: 1 of 2 fail' in text
    assert "Of 3 statements" in section(text, "brief")


@pytest.mark.parametrize("part", [
    "jl14 fig01 --output results/jones_legrand_2014",
    "wavebalance run reproduce/scenes/jones_legrand_2014/one.toml --set time.functions=8 --set time.trial=haar "
    "--output DIR",
    'href="jones_legrand_2014/scenes/one.toml"', "in SI units; a remark on the data", "commit abc123", "GNU 12",
    "0.25 s"])
def test_a_page_says_at_each_figure_how_to_compute_it_again_and_where_it_comes_from(page, part):
    assert part in copied(page())


def test_a_page_names_the_machine_that_made_it(page):
    cores = len(os.sched_getaffinity(0))
    with open("/proc/cpuinfo") as lines:
        name = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), None)
    machine = f"{name}, {cores} {'core' if cores == 1 else 'cores'}" if name else "unknown"
    assert f"Machine {html.escape(machine)}." in page()


def test_many_runs_of_a_scene_are_given_by_their_keys_and_values(page):

    def many(one):
        one["scenes"][0]["overrides"] = [[f"time.functions={number}"] for number in range(1, 21)]

    text = copied(page(many))
    assert "# 20 runs of this scene, with --set of\n  time.functions = 1, 2, 3" in text
    assert "--set time.functions=2 " not in text


def test_a_page_shows_the_picture_and_its_curves_and_links_the_paper(page):
    assert attributes(page(), "src").count(f"jones_legrand_2014/{STEM}.svg") == 1
    assert attributes(page(), "data-curves").count(f"jones_legrand_2014/{STEM}.figure.js") == 1
    assert 'The paper\'s own Fig. 1: <a href="https://hal.science/hal-01403614">' in page()


def test_a_large_vector_picture_is_shown_as_pixels(pages):
    large = IMAGE + " " * (2_000_000 - len(IMAGE))
    text = (pages(judged(), beside={f"{STEM}.svg": large}) / "index.html").read_text()
    assert attributes(text, "src").count(f"jones_legrand_2014/{STEM}.png") == 1
    assert not attributes(text, "data-curves")


def test_results_without_a_paper_are_not_quoted_from_one_and_not_judged(pages, page):
    one = judged()
    one["statements"] = []
    own = (pages(one, paper="blade") / "index.html").read_text()
    assert "Sentences are quoted" not in own
    assert 'id="brief"' not in own
    assert "#matrix" not in own
    assert "Sentences are quoted" in page()


def test_a_section_with_a_page_of_its_own_is_linked_in_place_of_being_shown(pages):
    folder = pages(judged(), paper="extremes")
    index, own = (folder / "index.html").read_text(), (folder / "extremes" / "index.html").read_text()
    assert 'href="extremes/index.html"' in index
    assert ">3</td>" not in index
    assert '<td>1 | &lt;2&gt;</td><td class="whole">3</td>' in own
    for target in ("../index.html", f"{STEM}.csv", "../assets/page.css"):
        assert f'href="{target}"' in own
    # It does not repeat its name in the next heading: "Extremes: inputs at the edge of ..."
    assert re.search(">Inputs at the edge of [^<]*</h2>", own)


def test_artefacts_stand_in_the_order_of_the_paper(pages):
    stems = ["fig01_a", "fig06_b", "rigid", "tab01_c"]
    text = (pages(*map(record, stems)) / "index.html").read_text()
    assert [name for name in attributes(text, "id") if name in stems] == ["fig01_a", "tab01_c", "fig06_b", "rigid"]


@pytest.mark.parametrize("quote, shown", [("word " * 50, "word " * 40 + "…"),
                                          ("word " * 39 + "words", "word " * 39 + "words")])
def test_quotations_of_the_matrix_are_shortened_at_a_blank(page, quote, shown):

    def long(one):
        one["statements"][0]["quote"] = quote

    assert shown in attributes(section(page(long), "matrix"), "title")
