"""What voices that are neural networks share: pronunciation by espeak-ng, sentences, pieces, and the worker."""
