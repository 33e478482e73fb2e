"""Files of matrices as Nastran and Abaqus write them, after the descriptions of their formats."""

import struct

import numpy as np

FORMAT, WIDTH, ON_A_LINE = "1P,3E23.16", 23, 3


def random_structure(size=9, seed=7):
    """Mass, damping without symmetry and stiffness with many digits, and a label (node, component) of each row."""
    draws = np.random.default_rng(seed)
    spread = draws.normal(size=(size, size)) * (draws.random((size, size)) < 0.4)
    stiffness = 1e6 * (spread @ spread.T + size * np.eye(size))
    nodes = np.repeat(draws.choice(np.arange(10, 9999), size // 3, replace=False), 3)
    mass = np.diag(draws.random(size) + 0.5)
    return mass, 10.0 * spread, stiffness, list(zip(nodes.tolist(), [1, 2, 6] * (size // 3), strict=True))


def ascending(matrix, labels):
    """The matrix, or vector, with its rows, and columns, by ascending labels."""
    order = sorted(range(len(labels)), key=lambda row: labels[row])
    return matrix[np.ix_(order, order)] if np.ndim(matrix) == 2 else matrix[order]


# DMIG

def small(*fields):
    return f"{fields[0]:8}" + "".join(f"{one:>8}" for one in fields[1:]) + "\n"


def large(*fields):
    return f"{fields[0]:8}" + "".join(f"{one:>16}" for one in fields[1:]) + "\n"


def header(name, form, kind, columns=""):
    return small("DMIG", f"{name:8}", 0, form, kind, 0, "", "", columns)


def real(value, digits=9):
    return f"{value:.{digits}E}".replace("E", "D")


def dmig(name, matrix, labels, form=6, write=large, triangle=np.triu):
    """Bulk data of a matrix: of a symmetric one a triangle, by columns."""
    text = header(name, form, 2)
    matrix = triangle(matrix) if form == 6 else matrix
    for column, label in enumerate(labels):
        rows = np.flatnonzero(matrix[:, column])
        if rows.size == 0:
            continue
        if write is large:
            text += large("DMIG*", f"{name:16}", *label)
            text += "".join(large("*", *labels[row], real(matrix[row, column])) for row in rows)
        else:
            entries = [(*labels[row], f"{matrix[row, column]:.8g}" if write is free else f"{matrix[row, column]:.1e}", "")
                       for row in rows]
            text += write("DMIG", name, *label, "", *entries[0])
            for first in range(1, len(entries), 2):
                text += write("", *(word for entry in entries[first:first + 2] for word in entry))
    return text


def free(*fields):
    return ",".join(str(one) for one in fields) + "\n"


def dmig_loads(name, loads, labels):
    """A rectangular matrix, whose columns have numbers."""
    text = header(name, 9, 2, loads.shape[1])
    for column in range(loads.shape[1]):
        text += large("DMIG*", f"{name:16}", column + 1, 0)
        text += "".join(large("*", *label, real(value)) for label, value in zip(labels, loads[:, column], strict=True) if value)
    return text


# OUTPUT4

def strings(column):
    """(first row from 0, values) of each stretch without zeros."""
    rows = np.flatnonzero(column)
    return [(part[0], column[part]) for part in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)] if rows.size else []


def value_lines(values):
    texts = [f"{value:{WIDTH}.16E}" for value in values]
    return "".join("".join(texts[i:i + ON_A_LINE]) + "\n" for i in range(0, len(texts), ON_A_LINE))


def output4_text(name, matrix, layout="dense", form=6, kind=2):
    """Text with dense columns, or strings ("sparse", or "bigmat" for many rows)."""
    rows, columns = matrix.shape
    words = 2 if kind == 2 else 1
    text = f"{columns:8}{-rows if layout == 'bigmat' else rows:8}{form:8}{kind:8}{name:8}{FORMAT}\n"
    for number in range(columns):
        parts = strings(matrix[:, number])
        if not parts:
            continue
        if layout == "dense":
            first, end = parts[0][0], parts[-1][0] + len(parts[-1][1])
            text += f"{number + 1:8}{first + 1:8}{end - first:8}\n" + value_lines(matrix[first:end, number])
            continue
        opening = 2 if layout == "bigmat" else 1
        text += f"{number + 1:8}{0:8}{sum(opening + words * len(values) for _, values in parts):8}\n"
        for first, values in parts:
            length = words * len(values) + 1
            text += f"{length:8}{first + 1:8}\n" if layout == "bigmat" else f"{first + 1 + 65536 * length:12}\n"
            text += value_lines(values)
    return text + f"{columns + 1:8}{1:8}{1:8}\n" + value_lines([1.0])


def output4_binary(name, matrix, layout="dense", form=6, kind=2, order="<", word=4):
    """Records of Fortran in either byte order, with words of four or eight bytes."""
    integer, number = ("i" if word == 4 else "q"), ("f" if kind == 1 and word == 4 else "d")
    words = (4 if number == "f" else 8) // word
    rows, columns = matrix.shape

    def record(integers, content=b""):
        content = struct.pack(f"{order}{len(integers)}{integer}", *integers) + content
        return struct.pack(order + "i", len(content)) + content + struct.pack(order + "i", len(content))

    def packed(values):
        return struct.pack(f"{order}{len(values)}{number}", *values)

    data = record([columns, -rows if layout == "bigmat" else rows, form, kind], name.ljust(2 * word).encode())
    for column in range(columns):
        parts = strings(matrix[:, column])
        if not parts:
            continue
        if layout == "dense":
            first, end = parts[0][0], parts[-1][0] + len(parts[-1][1])
            data += record([column + 1, first + 1, words * (end - first)], packed(matrix[first:end, column]))
            continue
        content = b""
        for first, values in parts:
            length = words * len(values) + 1
            opening = [length, first + 1] if layout == "bigmat" else [first + 1 + 65536 * length]
            content += struct.pack(f"{order}{len(opening)}{integer}", *opening) + packed(values)
        data += record([column + 1, 0, len(content) // word], content)
    return data + record([columns + 1, 1, words], packed([1.0]))


# Abaqus

def matrix_input(matrix, labels, separator=","):
    """*MATRIX OUTPUT, FORMAT=MATRIX INPUT: the lower triangle, or with blanks FORMAT=LABELS."""
    entries = [(*labels[i], *labels[j], f"{matrix[i, j]:.15e}")
               for j in range(len(labels)) for i in range(j, len(labels)) if matrix[i, j] != 0.0]
    return "".join(separator.join(map(str, entry)) + "\n" for entry in entries)


def concentrated_loads(load, labels):
    """*MATRIX OUTPUT, LOAD."""
    return "** Assembled nodal loads\n*CLOAD, REAL\n" + "".join(
        f"{node},{component},  {value:.15e}\n" for (node, component), value in zip(labels, load, strict=True) if value)


def substructure(matrices, labels, symmetric=True):
    """*SUBSTRUCTURE MATRIX OUTPUT: nodes in a comment, their components, and columns down to the diagonal."""
    nodes = list(dict.fromkeys(node for node, _ in labels))
    text = (f"**\n** ABAQUS SUBSTRUCTURE\n*USER ELEMENT, NODES= {len(nodes)}, LINEAR{'' if symmetric else ', UNSYMM'}\n"
            "** ELEMENT NODES\n** " + ", ".join(map(str, nodes[:2])) + ",\n** " + ", ".join(map(str, nodes[2:])) + "\n")
    for place, node in enumerate(nodes):
        components = ", ".join(str(component) for one, component in labels if one == node)
        text += f"{components}\n" if place == 0 else f"{place + 1}, {components}\n"
    for kind, matrix in matrices.items():
        text += f"*MATRIX,TYPE={kind}\n"
        for column in range(len(labels)):
            values = [f"{value:.15e}" for value in matrix[:column + 1 if symmetric else None, column]]
            text += "".join(" ,".join(values[i:i + 4]) + " ,\n" for i in range(0, len(values), 4))
    return text
