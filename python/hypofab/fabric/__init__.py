"""Contacts and their fabric: samples, changes, confidence."""
