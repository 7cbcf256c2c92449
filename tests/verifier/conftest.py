"""The proofs lie beside the tests; nothing is written into the tree."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
