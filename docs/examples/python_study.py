from concurrent.futures import ThreadPoolExecutor

import numpy as np
import wavebalance as wb

with ThreadPoolExecutor(2) as executor:
    study = wb.study("first.toml", {"contact.gap": np.linspace(0.5e-3, 1.5e-3, 5)}, executor=executor)
for gap, largest in zip(study.table["contact.gap"], study.table["max_displacement_m"]):
    print(f"gap {1e3 * gap:.2f} mm: {1e3 * largest:.3f} mm")
