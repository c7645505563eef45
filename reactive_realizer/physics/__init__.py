"""Physical simulation of figures with MuJoCo, and mixed dynamics (thesis, chapter 3). It knows nothing of BML."""
