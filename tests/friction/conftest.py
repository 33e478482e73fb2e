"""Small matrices gain nothing from threads, and wait for cores that other tests use."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
