"""The role `cite` links to an entry of theory/literature.rst, whose label is `ref-` and the key in lower case."""

from docutils import nodes
from sphinx import addnodes

SHOWN = {
    "Archard": "Archard 1953", "Jenkins": "Jenkins 1962", "Krack": "Krack 2015", "Krieg": "Krieg & Krieg 1977",
    "PetrovEwins": "Petrov & Ewins 2003",
    "JL14": "Jones & Legrand 2014", "LL10": "Laxalde & Legrand 2010", "AllgowerGeorg": "Allgower & Georg",
    "Beylkin": "Beylkin 1992", "CameronGriffin": "Cameron & Griffin 1989", "CottlePangStone": "Cottle, Pang & Stone",
    "CraigBampton": "Craig & Bampton 1968", "DankowiczSchilder": "Dankowicz & Schilder 2013", "Daubechies": "Daubechies 1992",
    "Grippo": "Grippo, Lampariello & Lucidi 1986", "Hairer": "Hairer, Nørsett & Wanner",
    "HaleTownsend": "Hale & Townsend 2014", "HuntCrossley": "Hunt & Crossley 1975", "Keller": "Keller 1977",
    "Moreau": "Moreau 1988", "Muller": "Müller 1995", "QiSun": "Qi & Sun 1993", "RestrepoLeaf": "Restrepo & Leaf 1993",
    "SaadSchultz": "Saad & Schultz 1986", "Seydel": "Seydel 2010", "ShawHolmes": "Shaw & Holmes 1983", "Skeel": "Skeel 1979",
    "WereleyHall": "Wereley & Hall 1990",
}


def cite(name, rawtext, text, lineno, inliner, options=None, content=None):
    if text not in SHOWN:
        message = inliner.reporter.error(f"unknown citation {text}", line=lineno)
        return [inliner.problematic(rawtext, rawtext, message)], [message]
    shown = f"[{SHOWN[text]}]"
    link = addnodes.pending_xref("", nodes.inline("", shown), refdomain="std", reftype="ref", refexplicit=True, refwarn=True,
                                 reftarget=f"ref-{text.lower()}", refdoc=inliner.document.settings.env.docname)
    return [link], []


def setup(app):
    app.add_role("cite", cite)
