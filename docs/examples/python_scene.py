import wavebalance as wb

record = wb.run("first.toml", {"forcing.frequency": 1290.0}, output="from_python")
print(record, record.summary["max_displacement_m"], "m")
print(record.response["displacement_m"][:3])
try:
    wb.run("first.toml", {"contact.gap": "wide"})
except wb.SceneError as error:
    print("refused:", error)
