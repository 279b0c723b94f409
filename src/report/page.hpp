// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "format/html.hpp"
#include "format/json.hpp"

namespace trueaxis {

/// The scripts of a job's page, of a machine's job and of a sweep, embedded by assets.S.
std::string_view job_script();
std::string_view machine_script();
std::string_view sweep_script();

/// One HTML page that opens offline: the template with its style, tables of the result that need no
/// script, Apache ECharts, data and the script, which puts its page in place of the tables.
/// @param result what the tables hold; nullptr: the data
std::string page_of(std::string_view title, std::string_view verdict, const Json& data,
                    std::string_view script, const Json* result = nullptr);

/// `data` as ASCII JSON in which no character can end or open an HTML element: < > & are written as
/// \u003c \u003e \u0026. Bytes that are not UTF-8 become U+FFFD; NaN becomes null.
std::string json_for_script(const Json& data);

/// Puts each text at its {{place}} in one sweep, so that no text is searched for places itself.
/// @throws ContractViolation if the template has a place without text.
std::string fill_template(
    std::string_view page,
    std::initializer_list<std::pair<std::string_view, std::string_view>> texts);

/// A result as HTML that needs no script: a section a member, objects as tables of name and value,
/// arrays of objects as tables with a row each, what lies deeper folded. A quantity is written with
/// its unit and u. Columns of charts (more than 16 numbers) are counted, not listed.
std::string plain_tables(const Json& result);

}  // namespace trueaxis
