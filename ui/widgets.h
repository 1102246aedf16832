#pragma once
// The few widgets that panels click through: each answers to the mouse and, by its label, to the script.

#include <initializer_list>
#include <string>

#include "ui/script.h"

namespace adit::ui {

/// True when clicked. The label (with what follows "##") is the name scripts use.
bool button(Script& script, const std::string& label, bool enabled = true, float width_px = 0.0F);

/// One of several choices side by side; true when clicked.
bool choice(Script& script, const std::string& label, bool chosen);

/// A row of a table that can be selected; spans its columns. True when clicked.
bool selectable_row(Script& script, const std::string& label, bool selected);

/// A slider over whole numbers [first, last] that shows `words`; true when moved.
bool slider(Script& script, const std::string& label, int& value, int first, int last, const std::string& words);

/// Begins a tab; true when its content is to be drawn, then close it with ImGui::EndTabItem().
bool begin_tab(Script& script, const std::string& label);

/// Grey words, wrapped.
void remark(const std::string& words);

/// Words in bold.
void heading(const std::string& words);

/// The words where a panel has nothing to show yet.
void nothing_yet(const std::string& words);

/// Begins a table with borders and headers; true when rows are to be drawn, then close it with ImGui::EndTable().
bool begin_table(const char* name, std::initializer_list<const char*> columns);

/// A number, name or word in a table's next cell; numbers stand on the right.
void cell(const std::string& words);
void number_cell(const std::string& words);

}  // namespace adit::ui
