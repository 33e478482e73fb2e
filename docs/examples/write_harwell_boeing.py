"""Writes the symmetric matrices of beam.py in the format of Harwell and Boeing, as HBMAT of Ansys does."""
from scipy.io import mmread
from scipy.sparse import csc_matrix, tril

for name in ("mass", "stiffness"):
    A = csc_matrix(tril(mmread(f"{name}.mtx")))  # the lower triangle, column after column
    A.sort_indices()
    parts = [[f"{i + 1:8d}" for i in A.indptr], [f"{i + 1:8d}" for i in A.indices], [f"{x:24.16E}" for x in A.data]]
    lines = [["".join(part[i:i + per]) for i in range(0, len(part), per)] for part, per in zip(parts, (10, 10, 3))]
    pointers, indices, values = map(len, lines)
    with open(f"{name}.rsa", "w") as file:
        file.write(f"{name:72s}{'1':8s}\n")
        file.write(f"{pointers + indices + values:14d}{pointers:14d}{indices:14d}{values:14d}{0:14d}\n")
        file.write(f"{'RSA':14s}{A.shape[0]:14d}{A.shape[1]:14d}{A.nnz:14d}{0:14d}\n")
        file.write(f"{'(10I8)':16s}{'(10I8)':16s}{'(3E24.16)':20s}\n")
        file.writelines(line + "\n" for part in lines for line in part)
