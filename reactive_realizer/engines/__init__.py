"""The modalities: one package an engine; they are strangers to each other and to the scheduler."""
