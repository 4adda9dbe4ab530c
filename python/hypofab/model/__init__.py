"""The model: materials, states, rates and increments, probes of a state."""
